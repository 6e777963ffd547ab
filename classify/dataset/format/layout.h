// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The arrays of a data set by path: the same in a shard, in the merged file and, without the leading slash, in .npz.
//
// The values that a scenario draws (sim/scenario/draws) have columns of their own, one per drawn key: /drawn/<key path>
// with numbers, or with text for a choice of words. The file's attributes drawn_numbers and drawn_words list the keys,
// separated by blanks; a data set without drawn values has neither.

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "classify/dataset/format/hdf5_file.h"
#include "classify/dataset/format/sample.h"

namespace seaglint {

struct StoredArray {
  const char* path;
  const char* units;
  const char* description;

  ArrayText text() const { return {units, description}; }
};

inline constexpr StoredArray kRangeAxis{"/axes/range_m", "m",
                                        "range relative to the target's reference point, positive = farther"};
inline constexpr StoredArray kVelocityAxis{"/axes/velocity_mps", "m/s", "radial velocity, positive = receding"};
inline constexpr StoredArray kMaps{"/maps", "m", "|RV|, [sample][velocity][range]"};
inline constexpr StoredArray kComplexMaps{"/maps_complex", "m", "RV, [sample][velocity][range][real, imaginary]"};
// Only in shards.
inline constexpr StoredArray kEchoes{"/echoes", "m",
                                     "echo of the target without clutter and noise over that of a point of 1 m, "
                                     "[sample][pulse][frequency][real, imaginary]"};
inline constexpr StoredArray kHopCodes{"/hop_code", "1", "carrier number of every pulse"};
inline constexpr StoredArray kCentres{"/centres", "m, m/s, m", "range_m, velocity_mps, amplitude_m"};

inline std::string column_path(const SampleColumn& column) { return std::string("/samples/") + column.name; }
inline ArrayText column_text(const SampleColumn& column, std::span<const std::string> classes) {
  return {column.unit, description_of(column, classes)};
}

// The type of a column's values.
template <class Member>
struct MemberType;
template <class T>
struct MemberType<T SampleRecord::*> {
  using Type = T;
};

// Keys of the drawn values, in the order of their columns.
struct DrawnKeys {
  std::vector<std::string> numbers;
  std::vector<std::string> words;

  bool operator==(const DrawnKeys&) const = default;
  bool empty() const { return numbers.empty() && words.empty(); }
};

DrawnKeys drawn_keys(const SampleRecord& record);

// True if two samples have the same keys and values.
bool same_drawn(const SampleRecord& a, const SampleRecord& b);

// "/drawn/sea.peak_period_s"
std::string drawn_path(const std::string& key);

// Unit of a key by its end ("m" of spacing_m; "1" without a unit), and a description.
ArrayText drawn_text(const std::string& key);

// Calls visit(key, value) with a double or a string for each drawn value of a sample.
template <class Visit>
void visit_drawn(const SampleRecord& record, Visit&& visit) {
  for (const auto& [key, value] : record.drawn_numbers) visit(key, value);
  for (const auto& [key, value] : record.drawn_words) visit(key, value);
}

// Creates /drawn with an array of `rows` values per key, in chunks of `chunk`; nothing without keys.
void create_drawn(Hdf5Writer& file, const DrawnKeys& keys, std::uint64_t rows, std::uint64_t chunk);

// Writes the values of records as rows from `first` on. All records have the same keys.
void write_drawn(Hdf5Writer& file, std::uint64_t first, const std::vector<const SampleRecord*>& records);

// Keys of a file. Throws WorkError for a name that is no key.
DrawnKeys read_drawn_keys(const Hdf5Reader& file);

// Reads rows from `first` on into records. Throws WorkError for arrays that are missing or too short.
void read_drawn(const Hdf5Reader& file, std::uint64_t first, const std::vector<SampleRecord*>& records);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A shard: consecutive samples in one HDF5 file. The bytes depend only on the content: no time, path, host or thread
// count.
//
//   /axes/range_m, /axes/velocity_mps   float64
//   /maps                               float32 [sample][velocity][range], metres, one chunk per sample
//   /maps_complex                       float32 [sample][velocity][range][2], metres; only with dataset.complex_maps
//   /echoes                             float64 [sample][pulse][frequency][2], metres; only with dataset.echoes
//   /hop_code                           uint16 [sample][pulse]
//   /centres                            float32 [sample][centre][range_m, velocity_mps, amplitude_m], zero beyond
//                                       /samples/centres
//   /samples/<column>                   [sample], one array per column of sample_columns(); of the first look where
//                                       they differ between looks
//   /looks/<column>                     [sample][look], one array per column of look_columns(); only with several looks
//   /drawn/<key path>                   [sample], numbers or text, one array per drawn key (sim/scenario/draws)
//
// With several looks (looks.count) maps, echoes, hop codes and centres have a dimension [look] after [sample].
//
// Attributes of the file: `format`, `program_version`, `processor`; `classes`, their names by label separated by ", ",
// where the scenario names them; `drawn_numbers` and `drawn_words`, the drawn keys separated by blanks, where there are
// any; of every array: `units`, `description`. Every chunk of an array has a Fletcher-32
// checksum, every header a checksum of its own (HDF5 1.8 format). The merged file and, without the leading
// slash, .npz have the same arrays.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "classify/dataset/format/hdf5_file.h"
#include "classify/dataset/format/sample.h"
#include "sim/core/process/error.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

// The arrays by path.

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
inline std::string look_path(const SampleColumn& column) { return std::string("/looks/") + column.name; }
inline ArrayText column_text(const SampleColumn& column, std::span<const std::string> classes) {
  return {column.unit, description_of(column, classes)};
}

// Keys of the drawn values, in the order of their columns.
struct DrawnKeys {
  std::vector<std::string> numbers;
  std::vector<std::string> words;

  bool operator==(const DrawnKeys&) const = default;
};

DrawnKeys drawn_keys(const SampleRecord& record);
DrawnKeys read_drawn_keys(const Hdf5Reader& file);  // throws WorkError for a name that is no key

// Unit of a key by its end ("m" of spacing_m; "1" without a unit), and a description.
ArrayText drawn_text(const std::string& key);

// Calls visit(key, value) with a double or a string for each drawn value of a sample.
template <class Visit>
void visit_drawn(const SampleRecord& record, Visit&& visit) {
  for (const auto& [key, value] : record.drawn_numbers) visit(key, value);
  for (const auto& [key, value] : record.drawn_words) visit(key, value);
}

// A column of some rows with its values.
struct StoredColumn {
  std::string path;  // "/samples/label", "/drawn/sea.peak_period_s"
  ArrayText text;
  std::variant<std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>> values;
};

// The columns of /samples and of /drawn. All rows have the same drawn keys.
struct StoredColumns {
  std::vector<StoredColumn> samples, drawn;
};
StoredColumns stored_columns(std::span<const SampleRecord> rows, std::span<const std::string> classes);
// Rows of all looks of samples, [sample][look]; the columns of /looks with their values in that order.
std::vector<SampleRecord> look_rows(std::span<const Sample> samples);
std::vector<StoredColumn> stored_look_columns(std::span<const SampleRecord> look_rows,
                                              std::span<const std::string> classes);

// Creates the array of a column with `rows` rows in chunks of `chunk`; of several looks each row has one value a look.
void create_column(Hdf5Writer& file, const StoredColumn& column, std::uint64_t rows, std::uint64_t chunk,
                   std::uint64_t looks = 1);
// Creates /drawn with its arrays and the attributes of the file; nothing without drawn keys.
void create_drawn(Hdf5Writer& file, const StoredColumns& columns, std::uint64_t rows, std::uint64_t chunk);
// Writes the values of a column as rows from `first` on.
void write_column(Hdf5Writer& file, const StoredColumn& column, std::uint64_t first);

// Reads the rows from `first` on, drawn values included. Throws WorkError for arrays that are missing or too short.
std::vector<SampleRecord> read_rows(const Hdf5Reader& file, std::uint64_t first, std::uint64_t count);

// "/samples/label": the first column in which two rows differ, where NaN equals NaN; "a drawn value"; "" if none.
std::string differing_column(const SampleRecord& a, const SampleRecord& b);

// Thrown for an intact file of a format that this program does not read.
class UnsupportedFormat : public InputError {
 public:
  using InputError::InputError;
};

// Program version and kind of processor that wrote a shard: maps may differ between versions, and in the last bit
// between processors.
struct Provenance {
  std::string program_version;
  std::string processor;

  bool operator==(const Provenance&) const = default;
};

struct Shard {
  Provenance origin;
  StoredAxes axes;
  std::vector<Sample> samples;
  std::vector<std::string> classes = default_classes();  // names by label

  std::vector<SampleRecord> rows() const;  // of the samples
};

// "shard_00012.h5"
std::string shard_name(std::size_t index);

// Writes the file completely or not at all and returns the SHA-256 of what it wrote, which need not be what lies there
// afterwards. All samples have the axes' size, equal numbers of pulses, and complex values or none; centre lists are
// padded to max_centres. Throws WorkError when the file cannot be written.
std::string write_shard(const std::filesystem::path& file, const Shard& shard, int max_centres);

// The bytes of a shard's file, read once, with their checksum.
struct ShardFile {
  std::filesystem::path path;
  Hdf5Image image;
  std::string sha256;
};

// Throws InputError when there is no such file, WorkError when the disk fails.
ShardFile load_shard(const std::filesystem::path& file);

// Reads and checks a shard. Throws InputError naming the file and its fault, UnsupportedFormat for another format. A
// file without a format is damaged, as is one with bytes behind its end.
Shard read_shard(const ShardFile& file);
Shard read_shard(const std::filesystem::path& file);

// True if the file has, byte for byte, what write_shard() writes for its content: the only test of bytes without
// meaning (padding, freed space) where no checksum is recorded.
bool is_as_written(const ShardFile& file, const Shard& content, int max_centres);

}  // namespace seaglint

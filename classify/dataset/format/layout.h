// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The arrays of a data set by path: the same in a shard, in the merged file and, without the leading slash, in .npz.

#include <span>
#include <string>
#include <variant>

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

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A shard: some consecutive samples in one HDF5 file. The bytes depend on the content alone: no time, path, host or
// thread count.
//
//   /axes/range_m, /axes/velocity_mps   float64
//   /maps                               float32 [sample][velocity][range], metres, one chunk per sample
//   /maps_complex                       float32 [sample][velocity][range][2], metres; only when asked for
//   /hop_code                           uint16 [sample][pulse]
//   /centres                            float32 [sample][centre][range_m, velocity_mps, amplitude_m], zero beyond
//                                       /samples/centres
//   /samples/<column>                   [sample], one array per column of sample_columns()
//
// Attributes of the file: `format`, `program_version`, `processor`; of every array: `units`, `description`. Every array
// carries a Fletcher-32 checksum per chunk, every header one of its own (HDF5 1.8 format).

#include <filesystem>
#include <string>
#include <vector>

#include "classify/dataset/format/sample.h"
#include "sim/core/process/error.h"

namespace seaglint {

// A whole file, but not of the format that this program reads.
class UnsupportedFormat : public InputError {
 public:
  using InputError::InputError;
};

// Who made the bytes: another version may make other maps, another kind of processor may round the last bit otherwise.
struct Provenance {
  std::string program_version;
  std::string processor;

  bool operator==(const Provenance&) const = default;
};

struct Shard {
  Provenance origin;
  StoredAxes axes;
  std::vector<Sample> samples;
};

// "shard_00012.h5"
std::string shard_name(std::size_t index);

// Writes the file whole or not at all. All samples have the axes' size, equal numbers
// of pulses, and complex values or none; centre lists are padded to max_centres. Throws WorkError when the disk
// refuses.
void write_shard(const std::filesystem::path& file, const Shard& shard, int max_centres);

// Reads and checks a shard. Throws InputError naming the file and what is wrong with it, UnsupportedFormat for one of
// another format.
Shard read_shard(const std::filesystem::path& file);

}  // namespace seaglint

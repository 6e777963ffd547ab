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
//   /samples/<column>                   [sample], one array per column of sample_columns()
//   /drawn/<key>                        [sample], one array per drawn key (layout.h); only with drawn values
//
// Attributes of the file: `format`, `program_version`, `processor`; `classes`, their names by label separated by ", ",
// where the scenario names them; of every array: `units`, `description`. Every chunk of an array has a Fletcher-32
// checksum, every header a checksum of its own (HDF5 1.8 format).

#include <filesystem>
#include <string>
#include <vector>

#include "classify/dataset/format/hdf5_file.h"
#include "classify/dataset/format/sample.h"
#include "sim/core/process/error.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

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

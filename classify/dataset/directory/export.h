// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// All shards of a data set, or some of them, in one file: HDF5 over the shards, and NumPy's .npz.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/hdf5_file.h"
#include "classify/dataset/format/npz.h"
#include "sim/core/process/parallel.h"

namespace seaglint {

// The merged file is one HDF5 file over all shards. Axes and the columns of samples/ are copied, so that rows can be
// selected from this file alone; maps, complex maps, hop codes and centres are virtual arrays whose rows are in the
// shards, by paths relative to the file. HDF5 reads rows of a missing shard as a fill value without an error: here NaN
// (65535 for hop codes), which cannot be mistaken for data. The bytes depend only on the shards and their relative
// paths.
inline constexpr const char* kMergedFile = "dataset.h5";

struct Merged {
  std::size_t shards = 0;
  std::size_t samples = 0;
  bool wrote_manifest = false;  // all shards existed without a manifest
};

// Verifies the checksum of every shard, then writes `file`. Without a manifest the shards are compared with the
// scenario first and the manifest is written for `program_version`. Throws InputError naming a shard that is missing,
// damaged or of another data set, or `file` when it does not end in .h5 or exists and is no merged file, and leaves
// `file` unchanged; WorkError when it cannot be written; Interrupted when *stop becomes true.
Merged merge_dataset(const std::filesystem::path& directory, const std::filesystem::path& file,
                     const std::string& program_version, const StopFlag* stop = nullptr);

// True for a file that merge_dataset() wrote, of any version.
bool is_merged(const std::filesystem::path& file);

// Directory of the data set whose shards a merged file is over. Throws InputError for a file that is no merged file,
// and for one whose shards are gone or of another manifest.
std::filesystem::path data_set_of_merged(const std::filesystem::path& file);

// A sentence if kMergedFile in the data set's directory is of another manifest: what reads that file by itself would
// pair labels of one data set with maps of another.
std::optional<std::string> merged_file_of_another_manifest(const DatasetReader& reader);

// Compares a merged file with its data set, shard by shard. Faults: a damaged file, another manifest, other sources
// than the shards, rows that differ from the shards'.
class MergedFileVerifier {
 public:
  MergedFileVerifier(std::filesystem::path file, const DatasetReader& reader);
  ~MergedFileVerifier();
  MergedFileVerifier(MergedFileVerifier&&) noexcept;

  void compare(std::size_t index, const Shard& shard);  // the shard as read from the disk
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  void fault(const std::string& what);

  std::filesystem::path file_;
  const DatasetReader* reader_;
  std::unique_ptr<Hdf5Reader> content_;  // null after a fault of the whole file
  std::vector<std::string> faults_;
};

// Exports shards to NumPy's .npz: the arrays of the shards under their names without the leading slash (`maps`,
// `samples/label`), complex maps as complex64 [sample][velocity][range], names as 64 bytes each. description.json
// inside lists units and meaning of every array and the provenance. Writes shards `first` to `first + count - 1` into
// one file, completely or not at all; count >= 1. Every shard's checksum is verified first. Memory holds one shard's
// maps and the rows of all samples (300 bytes each). Throws InputError naming a damaged shard, WorkError when the file
// cannot be written, Interrupted when *stop becomes true.
void export_shards(const DatasetReader& reader, std::size_t first, std::size_t count, const std::filesystem::path& file,
                   const StopFlag* stop = nullptr);

// A column as an array of .npz under its path without the leading slash; empty `shape`: a single value.
NpzArray npz_column(const StoredColumn& column, Dimensions shape);

// Checks a directory for an export of one .npz per shard: it must be new or empty, or contain only files of an export
// of the same data set, complete or incomplete. Throws InputError naming the directory and its content; the data set's
// own directory is rejected too.
void require_npz_directory(const DatasetReader& reader, const std::filesystem::path& directory);

}  // namespace seaglint

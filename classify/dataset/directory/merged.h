// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// One HDF5 file over all shards of a data set. Axes and the columns of samples/ are copied, so that choosing rows opens
// this file alone; maps, complex maps, hop codes and centres are virtual arrays whose rows lie in the shards, named
// relative to the file. HDF5 shows rows of a shard that is missing as a fill value without a word: here that is NaN
// (65535 for hop codes), so that nobody takes it for data. Bytes depend on the shards and their relative place alone.

#include <filesystem>
#include <string>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/hdf5_file.h"
#include "sim/core/process/parallel.h"

namespace seaglint {

inline constexpr const char* kMergedFile = "dataset.h5";

struct Merged {
  std::size_t shards = 0;
  std::size_t samples = 0;
  bool wrote_manifest = false;  // all shards were there, but nobody had written it
};

// Reads every shard against its checksum, then writes `file`. Without a manifest the shards are held against the
// scenario first and the manifest is written for `program_version`. Throws InputError naming the file that is missing,
// damaged or foreign, or `file` when it does not end in .h5 or is something else than a merged file already, and then
// leaves `file` as it was; WorkError when the disk refuses; Interrupted when *stop becomes true.
Merged merge_dataset(const std::filesystem::path& directory, const std::filesystem::path& file,
                     const std::string& program_version, const StopFlag* stop = nullptr);

// True for a file that merge_dataset() wrote, of any version.
bool is_merged(const std::filesystem::path& file);

// A merged file held against its data set, shard by shard. Faults are a file that is damaged, of another manifest, with
// other sources than the shards, or with rows that are not theirs.
class MergedFileVerifier {
 public:
  MergedFileVerifier(std::filesystem::path file, const DatasetReader& reader);
  ~MergedFileVerifier();
  MergedFileVerifier(MergedFileVerifier&&) noexcept;

  void compare(std::size_t index, const Shard& shard);  // the shard as it is on the disk
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  void fault(const std::string& what);

  std::filesystem::path file_;
  const DatasetReader* reader_;
  std::unique_ptr<Hdf5Reader> content_;  // null after a fault of the whole file
  std::vector<std::string> faults_;
};

}  // namespace seaglint

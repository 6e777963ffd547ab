// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reads a complete data set shard by shard.

#include <filesystem>

#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/shard.h"

namespace seaglint {

// Treatment of a directory whose scenario.yaml does not match the manifest's checksum: rejected, or accepted (for an
// audit).
enum class ScenarioMismatch { kReject, kAccept };

class DatasetReader {
 public:
  // Reads the manifest and checks that every shard and the scenario exist. Throws InputError naming a file that is
  // missing or wrong.
  explicit DatasetReader(std::filesystem::path directory, ScenarioMismatch other = ScenarioMismatch::kReject);

  const Manifest& manifest() const { return manifest_; }
  const std::filesystem::path& directory() const { return directory_; }
  std::size_t size() const { return static_cast<std::size_t>(manifest_.samples); }
  std::size_t shards() const { return manifest_.shards.size(); }

  // Reads one shard after comparing its checksum with the manifest's; its samples are those of the manifest, in order.
  // Throws InputError naming the file and its fault.
  Shard shard(std::size_t index) const;

 private:
  std::filesystem::path directory_;
  Manifest manifest_;
};

}  // namespace seaglint

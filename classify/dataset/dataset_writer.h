// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A data set directory in the making: scenario.yaml first, then shards in any order and by any number of processes,
// then manifest.json and the data card. A process that is killed leaves whole shards and at most a `.tmp` that the next
// run replaces.

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "classify/dataset/plan.h"
#include "classify/dataset/shard.h"

namespace seaglint {

inline constexpr const char* kScenarioFile = "scenario.yaml";
inline constexpr const char* kManifestFile = "manifest.json";
inline constexpr const char* kDataCardFile = "README.md";

class DatasetWriter {
 public:
  // Makes the directory and writes scenario.yaml. Without `resume` the directory must be new or empty; with it, a
  // scenario.yaml that is there must make the same maps (its learning section and split may differ). Throws InputError
  // naming the directory and the difference, WorkError when the disk refuses.
  DatasetWriter(std::filesystem::path directory, const Scenario& scenario, bool resume);

  // True when the shard is on the disk and sound: by the manifest's checksum where there is one, else by reading it
  // all.
  bool complete(std::size_t shard) const;

  // Writes a shard; from any thread.
  void put(std::size_t shard, const Shard& content);

  // Writes manifest and data card when all shards are there. Returns the number of shards that are still missing.
  std::size_t finish(const std::string& program_version);

  const std::filesystem::path& directory() const { return directory_; }

 private:
  std::filesystem::path shard_file(std::size_t shard) const;

  std::filesystem::path directory_;
  Scenario scenario_;
  SamplePlan plan_;
  std::string scenario_yaml_;
  std::vector<std::string> known_sha256_;  // of a manifest that was there already, by shard; empty without one
  std::mutex mutex_;                       // the HDF5 library serves one thread at a time
};

}  // namespace seaglint

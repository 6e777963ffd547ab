// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A data set directory in the making: scenario.yaml first, then shards in any order and by any number of processes,
// then manifest.json and the data card. A process that is killed leaves whole shards and at most a temporary file
// (classify/dataset/directory/temporary.h), which goes when the data set is whole.

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "classify/dataset/directory/file_names.h"
#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/shard.h"
#include "sim/scenario/sample_plan.h"

namespace seaglint {

// The data set's own files, those that `merge` and `export` make of it, what a kill left half-written, and hidden ones:
// a file server keeps so what was removed while another process had it open.
bool is_dataset_file(const std::string& name);

class DatasetWriter {
 public:
  // Makes the directory and writes scenario.yaml. Without `resume` the directory must be new or empty; with it, it must
  // hold nothing but files of a data set, a scenario.yaml that is there must make the same maps (its learning section
  // and split may differ), the files that it names be those that the directory was begun with, and the manifest, if
  // any, be of `program_version`. Throws InputError naming the directory and the difference, WorkError when the disk
  // refuses.
  DatasetWriter(std::filesystem::path directory, const Scenario& scenario, bool resume, std::string program_version)
      : DatasetWriter(std::move(directory), scenario, SamplePlan(scenario), resume, std::move(program_version)) {}
  DatasetWriter(std::filesystem::path directory, const Scenario& scenario, const SamplePlan& plan, bool resume,
                std::string program_version);

  // True when the shard is on the disk and sound: it is read, its rows are compared with the scenario, and its checksum
  // with the manifest's where there is one. Throws InputError when it is sound but another version of the program
  // made it: a data set of two versions would be neither's.
  bool complete(std::size_t shard);

  // Writes a shard, with this program and processor as its origin; from any thread. Throws WorkError when the disk
  // refuses and the shard is not there already. A manifest that was there goes first: other parts would hold the new
  // shard against it for ever.
  void put(std::size_t shard, Shard content);

  // Writes manifest and data card when all shards are there and sound, and removes what killed runs left half-written.
  // Returns the shards that are missing or damaged.
  std::vector<std::size_t> finish();

  // Takes back what the constructor put into a new or empty directory, where nothing else is yet; for a scenario of
  // which no sample can be made, by a process that nobody shares the directory with.
  void roll_back();

  const std::filesystem::path& directory() const { return directory_; }

 private:
  // What finish() needs to know of a sound shard.
  struct Known {
    bool sound = false;
    std::string processor;
    std::string sha256;
  };

  std::filesystem::path shard_file(std::size_t shard) const;
  void require_version(const std::filesystem::path& file, const std::string& version) const;
  Manifest manifest_there() const;  // without shards where there is none
  void invalidate_manifest();
  Manifest manifest() const;  // of a whole data set

  std::filesystem::path directory_;
  bool begun_here_ = false, made_here_ = false;  // the directory was empty; it was not there
  Scenario scenario_;
  SamplePlan plan_;
  Provenance origin_;
  std::string scenario_yaml_;
  Manifest earlier_;                // the manifest that was there already; without shards where none is, or retired
  std::vector<Known> known_;        // by shard
  std::optional<StoredAxes> axes_;  // of all shards
  std::mutex mutex_;                // the HDF5 library serves one thread at a time
};

}  // namespace seaglint

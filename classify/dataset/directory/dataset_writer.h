// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Writes a data set directory: scenario.yaml first, then shards in any order and by any number of processes, then
// manifest.json and the data card. A process that is killed leaves complete shards and temporary files, which are
// removed when the data set is complete. The part of a sample's row that the scenario determines decides whether a
// shard is of this data set.

#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/sample.h"
#include "classify/dataset/format/shard.h"
#include "sim/scenario/sample_plan.h"

namespace seaglint {

// The part of a sample's row that the scenario determines: sea, view, target, interval, keys and label. Fills the
// columns `sample` to `radar_key`; measured columns are zero. sample < plan.size(); plan of the same scenario.
SampleRecord planned_record(const Scenario& scenario, const SamplePlan& plan, std::size_t sample);
// The same with a known address of the sample, which saves the shuffle that finds it.
SampleRecord planned_record(const Scenario& scenario, const SamplePlan& plan, std::size_t sample,
                            const SampleAddress& address);

// The columns that planned_record() fills.
std::span<const SampleColumn> planned_columns();

// "label 0, by the scenario 1" for every column of `record` that differs from the planned value.
std::vector<std::string> record_mismatches(const SampleRecord& record, const SampleRecord& planned);

// True for names of a data set's files, of the outputs of `merge` and `export`, of temporary files, and of hidden
// files: network file systems keep a file under a hidden name if it was removed while another process had it open.
bool is_dataset_file(const std::string& name);

class DatasetWriter {
 public:
  // Creates the directory and writes scenario.yaml. Without `resume` the directory must be new or empty. With `resume`
  // it must contain only files of a data set; an existing scenario.yaml must define the same maps (its learning section
  // and split may differ), the files that it names must match inputs.sha256, and an existing manifest must be of
  // `program_version`. Throws InputError naming the directory and the difference, WorkError when a file cannot be
  // written.
  DatasetWriter(std::filesystem::path directory, const Scenario& scenario, bool resume, std::string program_version)
      : DatasetWriter(std::move(directory), scenario, SamplePlan(scenario), resume, std::move(program_version)) {}
  DatasetWriter(std::filesystem::path directory, const Scenario& scenario, const SamplePlan& plan, bool resume,
                std::string program_version);

  // True when the shard exists and is valid: it is readable, its rows match the scenario, and its checksum the
  // manifest's or, if there is none, every byte what is written for its content. Throws InputError when it is valid but
  // of another program version: versions must not be mixed in a data set.
  bool complete(std::size_t shard);

  // Writes a shard, with this program and processor as its provenance; from any thread. Throws WorkError when the file
  // cannot be written and the shard does not exist yet. An existing manifest is removed first: its checksum of this
  // shard would be wrong for other processes.
  void put(std::size_t shard, Shard content);

  // Writes manifest and data card when all shards exist and are valid, and removes the temporary files of killed
  // processes. Every shard is compared with what was written or checked. Returns the shards that are missing or
  // damaged.
  std::vector<std::size_t> finish();

  // Removes what the constructor wrote into a new or empty directory if it contains nothing else; for a scenario of
  // which no sample can be generated. No other process may use the directory.
  void roll_back();

  const std::filesystem::path& directory() const { return directory_; }

 private:
  // State of a shard for finish().
  struct Known {
    bool sound = false;
    std::string processor;
    std::string sha256;
  };

  std::filesystem::path shard_file(std::size_t shard) const;
  void require_version(const std::filesystem::path& file, const std::string& version) const;
  Manifest manifest_there() const;  // without shards if there is none
  void invalidate_manifest();
  // complete(), for a shard that is known too: it may since have been damaged, or replaced by that of a process on
  // another processor.
  bool still_sound(std::size_t shard);
  Manifest manifest() const;  // of a complete data set

  std::filesystem::path directory_;
  bool begun_here_ = false, made_here_ = false;  // the directory was empty; it did not exist
  Scenario scenario_;
  SamplePlan plan_;
  Provenance origin_;
  std::string scenario_yaml_;
  Manifest earlier_;  // the manifest found at construction; without shards if there was none or after invalidation
  std::vector<Known> known_;        // by shard
  std::optional<StoredAxes> axes_;  // of all shards
  std::mutex mutex_;
};

}  // namespace seaglint

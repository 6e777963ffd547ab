// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/dataset_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "classify/dataset/checksum.h"
#include "classify/dataset/data_card.h"
#include "classify/dataset/manifest.h"
#include "sim/core/error.h"
#include "sim/core/file.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

// "line 12: `seed: 43` there, `seed: 42` here"
std::string first_difference(const std::string& there, const std::string& here) {
  std::istringstream a(there), b(here);
  for (int line = 1;; ++line) {
    std::string left, right;
    const bool more_left = static_cast<bool>(std::getline(a, left));
    const bool more_right = static_cast<bool>(std::getline(b, right));
    if (!more_left && !more_right) return "the ends of the lines differ";
    if (left != right) return fmt::format("line {}: `{}` there, `{}` here", line, left, right);
  }
}

// The scenario as far as it decides the maps: learning may be changed over the same maps.
std::string maps_yaml(Scenario scenario) {
  scenario.learning = {};
  scenario.dataset.train_share = DatasetSpec{}.train_share;
  return effective_yaml(scenario);
}

bool is_empty_or_absent(const fs::path& directory) {
  std::error_code error;
  if (!fs::exists(directory, error)) return true;
  if (!fs::is_directory(directory, error)) {
    throw InputError(fmt::format("{}: is a file, not a directory", directory.string()));
  }
  const bool empty = fs::is_empty(directory, error);
  if (error) throw WorkError(fmt::format("{}: {}", directory.string(), error.message()));
  return empty;
}

}  // namespace

DatasetWriter::DatasetWriter(fs::path directory, const Scenario& scenario, bool resume)
    : directory_(std::move(directory)), scenario_(scenario), plan_(scenario), scenario_yaml_(effective_yaml(scenario)) {
  if (!resume && !is_empty_or_absent(directory_)) {
    throw InputError(
        fmt::format("{}: the directory is not empty; go on with what is there by --resume", directory_.string()));
  }
  make_directory(directory_);
  const fs::path scenario_file = directory_ / kScenarioFile;
  if (fs::exists(scenario_file)) {
    const std::string there = maps_yaml(read_scenario(scenario_file)), here = maps_yaml(scenario_);
    if (there != here) {
      throw InputError(fmt::format("{}: the directory holds another scenario ({}); choose another directory",
                                   scenario_file.string(), first_difference(there, here)));
    }
  }
  write_file(scenario_file, scenario_yaml_);
  const fs::path manifest_file = directory_ / kManifestFile;
  if (fs::exists(manifest_file)) {
    for (const ManifestShard& shard : read_manifest(manifest_file).shards) known_sha256_.push_back(shard.sha256);
  }
}

fs::path DatasetWriter::shard_file(std::size_t shard) const { return directory_ / shard_name(shard); }

bool DatasetWriter::complete(std::size_t shard) const {
  const fs::path file = shard_file(shard);
  if (!fs::is_regular_file(file)) return false;
  if (shard < known_sha256_.size()) return sha256_file(file) == known_sha256_[shard];
  try {
    const Shard content = read_shard(file);
    const ShardRange range = plan_.shard(shard);
    if (content.samples.size() != range.count) return false;
    for (std::size_t i = 0; i < range.count; ++i) {
      if (content.samples[i].record.sample != static_cast<std::int64_t>(range.first + i)) return false;
    }
    return true;
  } catch (const InputError&) {
    return false;
  }
}

void DatasetWriter::put(std::size_t shard, const Shard& content) {
  const std::lock_guard lock(mutex_);
  write_shard(shard_file(shard), content, scenario_.features.max_centres);
}

std::size_t DatasetWriter::finish(const std::string& program_version) {
  std::size_t missing = 0;
  for (std::size_t i = 0; i < plan_.shards(); ++i) missing += fs::is_regular_file(shard_file(i)) ? 0 : 1;
  if (missing > 0) return missing;

  Manifest manifest;
  manifest.scenario = scenario_.name;
  manifest.scenario_sha256 = sha256(scenario_yaml_);
  manifest.program_version = program_version;
  manifest.processor = processor_kind();
  manifest.seed = scenario_.seed;
  manifest.samples = plan_.size();
  const StoredAxes axes = read_shard(shard_file(0)).axes;
  manifest.rows = axes.velocity_mps.size();
  manifest.columns = axes.range_m.size();
  for (std::size_t i = 0; i < plan_.shards(); ++i) {
    const ShardRange range = plan_.shard(i);
    manifest.shards.push_back({shard_name(i), range.first, range.count, sha256_file(shard_file(i))});
  }
  write_file(directory_ / kDataCardFile, data_card(scenario_, manifest, axes));
  write_file(directory_ / kManifestFile, to_json(manifest));
  return 0;
}

}  // namespace seaglint

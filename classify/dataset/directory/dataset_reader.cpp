// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/dataset_reader.h"

#include <fmt/format.h>

#include <utility>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/dataset/format/checksum.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

constexpr const char* kRemedy = "make it again by `seaglint generate SCENARIO -o DIR --resume`";

}  // namespace

DatasetReader::DatasetReader(fs::path directory, ScenarioMismatch other) : directory_(std::move(directory)) {
  if (!fs::is_directory(directory_)) throw InputError(fmt::format("{}: no such directory", directory_.string()));
  const fs::path manifest_file = directory_ / kManifestFile;
  if (!fs::exists(manifest_file)) {
    throw InputError(fmt::format("{}: no {}: not a data set, or one that is not finished ({})", directory_.string(),
                                 kManifestFile, kRemedy));
  }
  manifest_ = read_manifest(manifest_file);
  for (const ManifestShard& shard : manifest_.shards) {
    if (!fs::is_regular_file(directory_ / shard.file)) {
      throw InputError(
          fmt::format("{}: missing, but the manifest lists it; {}", (directory_ / shard.file).string(), kRemedy));
    }
  }
  const fs::path scenario = directory_ / kScenarioFile;
  if (other == ScenarioMismatch::kReject && sha256_file(scenario) != manifest_.scenario_sha256) {
    throw InputError(fmt::format(
        "{}: is not the one that the manifest was written for; bring that one back, or go on with another `learning` "
        "by `seaglint generate SCENARIO -o DIR --resume`",
        scenario.string()));
  }
}

Shard DatasetReader::shard(std::size_t index) const {
  SEAGLINT_CHECK(index < manifest_.shards.size(), fmt::format("shard {} of {}", index, manifest_.shards.size()));
  const ManifestShard& entry = manifest_.shards[index];
  const fs::path file = directory_ / entry.file;
  const ShardFile loaded = load_shard(file);
  if (loaded.sha256 != entry.sha256) {
    // Reading it may give a more specific fault than the checksum.
    std::string detail = "its checksum is not the manifest's";
    try {
      read_shard(loaded);
    } catch (const InputError& error) {
      detail = error.what() + file.string().size() + 2;
    }
    throw InputError(fmt::format("{}: truncated or changed: {}; {}", file.string(), detail, kRemedy));
  }
  Shard shard = read_shard(loaded);
  if (shard.samples.size() != entry.samples || shard.axes.velocity_mps.size() != manifest_.rows ||
      shard.axes.range_m.size() != manifest_.columns) {
    throw InputError(fmt::format("{}: does not contain what the manifest lists", file.string()));
  }
  for (std::size_t row = 0; row < shard.samples.size(); ++row) {
    const std::int64_t sample = shard.samples[row].record.sample;
    const std::uint64_t planned = entry.first_sample + row;
    if (sample != static_cast<std::int64_t>(planned)) {
      throw InputError(
          fmt::format("{}: row {} contains sample {}, by the manifest {}", file.string(), row, sample, planned));
    }
  }
  return shard;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/dataset_reader.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "classify/dataset/format/manifest.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/text_source.h"
#include "sim/core/text/words.h"
#include "sim/geometry/files/mesh_io.h"

namespace seaglint {

bool is_temporary(const std::string& name) {
  const std::string_view target = target_of_temporary(name);
  for (const std::string_view own : kSingleFiles) {
    if (target == own) return true;
  }
  for (const std::string_view ending : {".h5", ".npz"}) {
    if (target.size() > ending.size() && target.ends_with(ending)) return true;
  }
  return false;
}

namespace fs = std::filesystem;

namespace {

// Checksums by key, from lines "CHECKSUM KEY".
std::map<std::string, std::string> read_list(const fs::path& file) {
  std::map<std::string, std::string> checksums;
  const TextSource source = TextSource::read(file);
  for (std::string_view rest = source.text(); !rest.empty();) {
    const std::string_view line = next_line(rest);
    const std::size_t gap = line.find("  ");
    if (gap == std::string_view::npos)
      source.fail(line, fmt::format("{}: must be a checksum and a key", in_quotes(line)));
    const bool is_new = checksums.emplace(line.substr(gap + 2), line.substr(0, gap)).second;
    if (!is_new) source.fail(line.substr(gap + 2), fmt::format("{} appears twice", in_quotes(line.substr(gap + 2))));
  }
  return checksums;
}

// Every file that the scenario names, and under "KEY/NAME" the buffer files of a mesh.
std::vector<InputFile> all_files(const Scenario& scenario) {
  std::vector<InputFile> files;
  for (const InputFile& named : input_files(scenario)) {
    files.push_back(named);
    if (!named.key.ends_with(".mesh")) continue;
    for (const fs::path& sidecar : sidecar_files(named.path)) {
      const fs::path name = sidecar.lexically_relative(fs::canonical(named.path).parent_path());
      files.push_back({fmt::format("{}/{}", named.key, name.string()), sidecar});
    }
  }
  return files;
}

}  // namespace

void require_same_inputs(const fs::path& directory, const Scenario& scenario) {
  const fs::path list = directory / kInputsFile;
  if (!fs::exists(list)) return;
  const std::map<std::string, std::string> checksums = read_list(list);
  for (const InputFile& file : all_files(scenario)) {
    const auto known = checksums.find(file.key);
    if (known != checksums.end() && known->second == sha256_file(file.path)) continue;
    throw InputError(fmt::format(
        "{}: {}: {} is not the file that the data set was begun with; bring that one back or choose another directory",
        list.string(), file.key, file.path.string()));
  }
}

void write_input_list(const fs::path& directory, const Scenario& scenario) {
  const fs::path list = directory / kInputsFile;
  if (fs::exists(list)) return;
  std::string text;
  for (const InputFile& file : all_files(scenario)) text += fmt::format("{}  {}\n", sha256_file(file.path), file.key);
  if (!text.empty()) write_file(list, text);
}

constexpr const char* kRemedy = "make it again by `seaglint generate SCENARIO -o DIR --resume`";

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
      shard.axes.range_m.size() != manifest_.columns || look_count(shard.samples.front()) != manifest_.looks) {
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

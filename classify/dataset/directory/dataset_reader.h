// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The directory of a data set: names of its files, the list of the scenario's inputs, and reading of complete data sets
// shard by shard.

#include <filesystem>
#include <string>

#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/shard.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// Names of the single files (all but the shards).
inline constexpr const char* kScenarioFile = "scenario.yaml";
inline constexpr const char* kInputsFile = "inputs.sha256";
inline constexpr const char* kManifestFile = "manifest.json";
inline constexpr const char* kDataCardFile = "README.md";
inline constexpr const char* kCroissantFile =
    "croissant.json";  // by Dataset.card() of the Python package, as is the next
inline constexpr const char* kColumnsFile = "columns.csv";
inline constexpr const char* kSingleFiles[] = {kScenarioFile, kInputsFile,    kManifestFile,
                                               kDataCardFile, kCroissantFile, kColumnsFile};

// True for a temporary file (sim/core/process/file.h), which a killed process leaves: of a shard, a merged or
// exported file, scenario, input list, data card or manifest.
bool is_temporary(const std::string& name);

// inputs.sha256 lists the checksum of every file that a scenario names, to detect changed meshes, tables and codes
// under the same names. Throws InputError naming the key and its file if one is missing or differs from the directory's
// list. Without a list every file passes.
void require_same_inputs(const std::filesystem::path& directory, const Scenario& scenario);

// Writes the list if there is none and the scenario names files.
void write_input_list(const std::filesystem::path& directory, const Scenario& scenario);

// Treatment of a directory whose scenario.yaml does not match the manifest's checksum: rejected, or accepted (for an
// audit).
enum class ScenarioMismatch { kReject, kAccept };

// Reads a complete data set shard by shard.
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

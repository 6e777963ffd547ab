// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// manifest.json: content of a data set, with a checksum of every shard. It is written last: a data set without it is
// incomplete. Checksums are SHA-256 (FIPS 180-4), as 64 lower-case hexadecimal digits.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/learning_spec.h"

namespace seaglint {

std::string sha256(std::string_view bytes);
std::string sha256_file(const std::filesystem::path& file);  // the errors of read_file()

struct ManifestShard {
  std::string file;
  std::uint64_t first_sample = 0;
  std::uint64_t samples = 0;
  std::string sha256;
};

struct Manifest {
  std::string scenario;         // its name
  std::string scenario_sha256;  // of scenario.yaml
  std::string program_version;
  std::vector<std::string> processors;  // kinds that wrote the shards, sorted: the last bit may differ between kinds
  std::uint64_t seed = 0;
  std::uint64_t samples = 0;
  std::uint64_t rows = 0;     // velocity cells of a map
  std::uint64_t columns = 0;  // range cells of a map
  std::uint64_t looks = 1;    // of a sample; in the file where there are several
  std::vector<ManifestShard> shards;
  std::vector<std::string> classes = default_classes();  // names by label; in the file where they are others
};

std::string to_json(const Manifest& manifest);              // with the descriptions of all columns
Manifest read_manifest(const std::filesystem::path& file);  // throws InputError naming the file and the entry

// The kind of processor as reported by the system, else "unknown".
std::string processor_kind();

}  // namespace seaglint

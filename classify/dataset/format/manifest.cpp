// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/manifest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "classify/dataset/format/sample.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/json.h"

namespace seaglint {
namespace {

class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    SEAGLINT_CHECK(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1,
                   "SHA-256 is not available");
  }

  void add(const char* bytes, std::size_t count) {
    SEAGLINT_CHECK(EVP_DigestUpdate(context_.get(), bytes, count) == 1, "SHA-256 update");
  }

  std::string hexadecimal() {
    unsigned char value[EVP_MAX_MD_SIZE];
    unsigned int length = 0;
    SEAGLINT_CHECK(EVP_DigestFinal_ex(context_.get(), value, &length) == 1, "SHA-256 end");
    return fmt::format("{:02x}", fmt::join(value, value + length, ""));
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

using nlohmann::ordered_json;

constexpr const char* kManifestFormat = "seaglint data set 4";

// Upper limits of a scenario: dataset.maps_per_shard, and all maps of its sweeps.
constexpr std::uint64_t kMaxShardSamples = 10000;
constexpr std::uint64_t kMaxSamples = 1000000000;

}  // namespace

std::string sha256(std::string_view bytes) {
  Digest digest;
  digest.add(bytes.data(), bytes.size());
  return digest.hexadecimal();
}

std::string sha256_file(const std::filesystem::path& file) {
  Digest digest;
  read_blocks(file, [&](std::string_view block) { digest.add(block.data(), block.size()); });
  return digest.hexadecimal();
}

std::string to_json(const Manifest& manifest) {
  ordered_json json;
  json["format"] = kManifestFormat;
  json["scenario"] = manifest.scenario;
  json["scenario_sha256"] = manifest.scenario_sha256;
  json["program_version"] = manifest.program_version;
  json["processors"] = manifest.processors;
  json["seed"] = manifest.seed;
  json["samples"] = manifest.samples;
  if (manifest.classes != default_classes()) json["classes"] = manifest.classes;
  json["map"] = {{"rows", manifest.rows}, {"columns", manifest.columns}, {"units", "m"}};
  if (manifest.looks > 1) json["map"]["looks"] = manifest.looks;
  json["shards"] = ordered_json::array();
  for (const ManifestShard& shard : manifest.shards) {
    json["shards"].push_back({{"file", shard.file},
                              {"first_sample", shard.first_sample},
                              {"samples", shard.samples},
                              {"sha256", shard.sha256}});
  }
  json["columns"] = ordered_json::array();
  for (const SampleColumn& column : sample_columns()) {
    json["columns"].push_back(
        {{"name", column.name}, {"units", column.unit}, {"description", description_of(column, manifest.classes)}});
  }
  return json.dump(2) + "\n";
}

Manifest read_manifest(const std::filesystem::path& file) {
  const std::string text = read_file(file, std::size_t{256} << 20);
  check_json(text, file.string(), kMaxOrderedKeys);
  try {
    const ordered_json json = ordered_json::parse(text);
    if (json.at("format") != kManifestFormat) {
      throw InputError(fmt::format("{}: format {}; this program reads \"{}\"", file.string(),
                                   shown(json.at("format").dump()), kManifestFormat));
    }
    Manifest manifest;
    manifest.scenario = json.at("scenario").get<std::string>();
    manifest.scenario_sha256 = json.at("scenario_sha256").get<std::string>();
    manifest.program_version = json.at("program_version").get<std::string>();
    manifest.processors = json.at("processors").get<std::vector<std::string>>();
    if (json.contains("classes")) manifest.classes = json.at("classes").get<std::vector<std::string>>();
    const auto whole = [&](const ordered_json& object, const char* key) {
      return whole_number(object, key, file.string());
    };
    manifest.seed = whole(json, "seed");
    manifest.samples = whole(json, "samples");
    manifest.rows = whole(json.at("map"), "rows");
    manifest.columns = whole(json.at("map"), "columns");
    if (json.at("map").contains("looks")) manifest.looks = whole(json.at("map"), "looks");
    std::uint64_t next = 0;
    for (const ordered_json& entry : json.at("shards")) {
      ManifestShard shard{entry.at("file").get<std::string>(), whole(entry, "first_sample"), whole(entry, "samples"),
                          entry.at("sha256").get<std::string>()};
      // A name with a folder could refer to a file outside the directory.
      if (shard.file.empty() || std::filesystem::path(shard.file).filename() != shard.file) {
        throw InputError(
            fmt::format("{}: shards: \"{}\" is not the name of a file beside it", file.string(), shard.file));
      }
      if (shard.first_sample != next) {
        throw InputError(fmt::format("{}: shards: {} does not follow on sample {}", file.string(), shard.file, next));
      }
      if (shard.samples < 1 || shard.samples > kMaxShardSamples) {
        throw InputError(fmt::format("{}: shards: {}: samples: {}, must be within 1 and {}", file.string(), shard.file,
                                     shard.samples, kMaxShardSamples));
      }
      next += shard.samples;
      manifest.shards.push_back(std::move(shard));
    }
    if (next != manifest.samples) {
      throw InputError(
          fmt::format("{}: samples: {}, but the shards contain {}", file.string(), manifest.samples, next));
    }
    if (next < 1 || next > kMaxSamples) {
      throw InputError(
          fmt::format("{}: samples: {}, must be within 1 and {}", file.string(), manifest.samples, kMaxSamples));
    }
    return manifest;
  } catch (const ordered_json::exception& error) {
    throw InputError(fmt::format(
        "{}: {}; the shards are kept: remove this file and go on by `seaglint generate SCENARIO -o DIR --resume`",
        file.string(), json_problem(error)));
  }
}

std::string processor_kind() {
  std::ifstream information("/proc/cpuinfo");
  for (std::string line; std::getline(information, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/croissant_audit.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/manifest.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/json.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

constexpr const char* kRemedy = "make the cards again by `seaglint card DIR`";

// SHA-256 of the files beside croissant.json, by name; files elsewhere (URLs, other folders) are left out.
std::map<std::string, std::string> listed_files(const fs::path& file) {
  const std::string text = read_file(file);
  check_json(text, file.string());
  std::map<std::string, std::string> listed;
  const auto json = nlohmann::json::parse(text);
  for (const auto& resource : json.at("distribution")) {
    const auto url = resource.find("contentUrl"), sha256 = resource.find("sha256");
    if (url == resource.end() || sha256 == resource.end()) continue;
    const auto name = url->get<std::string>();
    if (!name.empty() && fs::path(name).filename() == name) listed[name] = sha256->get<std::string>();
  }
  return listed;
}

}  // namespace

std::vector<std::string> croissant_faults(const fs::path& directory, const Manifest& manifest) {
  const fs::path file = directory / kCroissantFile;
  if (!fs::exists(file)) return {};
  std::vector<std::string> faults;
  const auto fault = [&](const std::string& what) {
    faults.push_back(fmt::format("{}: {}; {}", kCroissantFile, what, kRemedy));
  };
  try {
    std::map<std::string, std::string> listed = listed_files(file);
    for (const ManifestShard& shard : manifest.shards) {
      const auto entry = listed.extract(shard.file);
      if (entry.empty()) {
        fault(fmt::format("does not list {}", shard.file));
      } else if (entry.mapped() != shard.sha256) {
        fault(fmt::format("the SHA-256 of {} is not the manifest's", shard.file));
      }
    }
    for (const auto& [name, sha256] : listed) {
      const fs::path there = directory / name;
      if (!fs::is_regular_file(there)) {
        fault(fmt::format("lists {}, which is missing", in_quotes(name)));
      } else if (sha256_file(there) != sha256) {
        fault(fmt::format("the SHA-256 of {} is another one", in_quotes(name)));
      }
    }
  } catch (const nlohmann::json::exception& error) {
    fault(json_problem(error));
  } catch (const InputError& error) {
    fault(error.what());
  }
  return faults;
}

}  // namespace seaglint

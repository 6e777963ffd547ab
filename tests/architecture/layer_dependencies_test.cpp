// SPDX-License-Identifier: BSD-3-Clause
// The corridor holds: a file includes its own stage or stages to its left, and third-party libraries stay behind one
// file per stage.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;    // relative to the root
  std::string header;  // as written
  bool system = false;
};

std::vector<std::string> stage_list() {
  std::vector<std::string> stages;
  std::istringstream list(SEAGLINT_STAGES);
  for (std::string stage; std::getline(list, stage, ',');) stages.push_back(stage);
  return stages;
}

std::vector<Include> includes_below(const std::string& stage) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*([<"])([^">]+)[">])re");
  std::vector<Include> found;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SEAGLINT_SOURCE_DIR) / stage)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      std::smatch match;
      if (std::regex_search(line, match, pattern)) {
        found.push_back({fs::relative(entry.path(), SEAGLINT_SOURCE_DIR).string(), match[2], match[1] == "<"});
      }
    }
  }
  return found;
}

// The index of the stage a root-relative header belongs to, -1 when it belongs to none.
int stage_of(const std::vector<std::string>& stages, const std::string& header) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (header.starts_with(stages[i] + "/")) return static_cast<int>(i);
  }
  return -1;
}

TEST(StageOrder, AFileIncludesItsOwnStageOrStagesToItsLeft) {
  const auto stages = stage_list();
  ASSERT_GE(stages.size(), 10u);
  int project_includes = 0;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    for (const Include& include : includes_below(stages[i])) {
      if (include.system || include.header.starts_with("seaglint_")) continue;
      const int stage = stage_of(stages, include.header);
      EXPECT_GE(stage, 0) << include.file << " includes \"" << include.header
                          << "\", which is not written from the root";
      EXPECT_LE(stage, static_cast<int>(i))
          << include.file << " includes \"" << include.header << "\", which is downstream";
      ++project_includes;
    }
  }
  EXPECT_GT(project_includes, 20) << "the test reads no includes";
}

TEST(StageOrder, ThirdPartyHeadersStayBehindOneSourceFilePerStage) {
  const std::regex wrapped("^(embree3|OpenMesh|tiny_gltf|yaml-cpp|fftw3|xgboost|torch|hdf5|H5|openssl|zip\\.h)");
  for (const std::string& stage : stage_list()) {
    std::map<std::string, std::set<std::string>> users;
    for (const Include& include : includes_below(stage)) {
      std::smatch match;
      if (include.system && std::regex_search(include.header, match, wrapped)) users[match[1]].insert(include.file);
    }
    for (const auto& [library, files] : users) {
      EXPECT_EQ(files.size(), 1u) << library << " appears in several files of " << stage << ", first "
                                  << *files.begin();
      for (const std::string& file : files) EXPECT_TRUE(file.ends_with(".cpp")) << file << " exposes " << library;
    }
  }
}

TEST(StageOrder, EveryFileCarriesItsLicence) {
  std::vector<std::string> folders = stage_list();
  folders.emplace_back("tests");
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SEAGLINT_SOURCE_DIR) / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream file(entry.path());
      std::string first;
      std::getline(file, first);
      EXPECT_EQ(first, "// SPDX-License-Identifier: BSD-3-Clause") << entry.path();
    }
  }
}

}  // namespace

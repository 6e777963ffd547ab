// SPDX-License-Identifier: BSD-3-Clause
// A file includes only its own stage or room or those before it in the order of folders, and each stage includes a
// third-party library in one source file only.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/includes.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Index of a file's folder in the order, -1 when it belongs to none. Rooms precede the stage that they are in.
int place_of(const std::vector<std::string>& folders, const std::string& file) {
  for (std::size_t i = 0; i < folders.size(); ++i) {
    if (file.starts_with(folders[i] + "/")) return static_cast<int>(i);
  }
  return -1;
}

std::vector<std::string> backward_includes(const std::vector<Include>& includes,
                                           const std::vector<std::string>& folders) {
  std::vector<std::string> found;
  for (const Include& include : includes) {
    const int from = place_of(folders, include.file);
    if (from < 0 || include.system || include.is_generated()) continue;
    const int to = place_of(folders, include.header);
    if (to < 0)
      found.push_back(include.file + " includes \"" + include.header + "\", which is not written from the root");
    if (to > from) found.push_back(include.file + " includes \"" + include.header + "\", which is downstream");
  }
  return found;
}

TEST(LayerDependencies, FileIncludesItsOwnStageAndRoomOrThoseToItsLeft) {
  ASSERT_GE(stage_list().size(), 10u);
  const std::vector<Include> includes = includes_of(code_files());
  EXPECT_GT(includes.size(), 1000u) << "the test reads no includes";
  EXPECT_THAT(backward_includes(includes, ordered_folders(stage_list(), room_list())), IsEmpty());
}

TEST(LayerDependencies, BackwardIncludesOfStagesAndRoomsAreFound) {
  const std::vector<std::string> folders = ordered_folders({"sim/a", "sim/b"}, {"sim/b/left", "sim/b/right"});
  EXPECT_THAT(folders, ElementsAre("sim/a", "sim/b/left", "sim/b/right", "sim/b"));
  const auto of = [&](const std::string& file, const std::string& header) {
    return backward_includes({{file, header}}, folders);
  };
  EXPECT_THAT(of("sim/b/right/x.cpp", "sim/b/left/y.h"), IsEmpty());
  EXPECT_THAT(of("sim/b/left/x.cpp", "sim/a/y.h"), IsEmpty());
  EXPECT_THAT(of("sim/b/x.cpp", "sim/b/right/y.h"), IsEmpty());
  EXPECT_THAT(of("sim/b/left/x.cpp", "sim/b/right/y.h"), ElementsAre(HasSubstr("downstream")));
  EXPECT_THAT(of("sim/b/right/x.cpp", "sim/b/y.h"), ElementsAre(HasSubstr("downstream")));
  EXPECT_THAT(of("sim/a/x.cpp", "sim/b/left/y.h"), ElementsAre(HasSubstr("downstream")));
  EXPECT_THAT(of("sim/a/x.cpp", "y.h"), ElementsAre(HasSubstr("not written from the root")));
}

// Of a stage's sub-folders only rooms are compiled.
TEST(LayerDependencies, EveryFileOfAStageIsInItsFolderOrARoom) {
  const std::vector<std::string> folders = ordered_folders(stage_list(), room_list());
  std::set<std::string> filled;
  for (const SourceFile& file : code_files()) {
    if (file.is_below("tests")) continue;
    const std::string folder = file.path.substr(0, file.path.rfind('/'));
    filled.insert(folder);
    EXPECT_THAT(folders, testing::Contains(folder)) << file.path << " is in no stage and no room of one";
  }
  for (const std::string& room : room_list()) EXPECT_TRUE(filled.contains(room)) << room << " has no files";
}

TEST(LayerDependencies, ThirdPartyHeadersStayBehindOneSourceFilePerStage) {
  const std::regex wrapped("^(CLI|embree3|OpenMesh|tiny_gltf|yaml-cpp|fftw3|xgboost|torch|hdf5|H5|openssl|zip\\.h)");
  const std::vector<Include> includes = includes_of(code_files());
  for (const std::string& stage : stage_list()) {
    std::map<std::string, std::set<std::string>> users;
    for (const Include& include : includes) {
      std::smatch match;
      if (include.file.starts_with(stage + "/") && include.system && std::regex_search(include.header, match, wrapped))
        users[match[1]].insert(include.file);
    }
    for (const auto& [library, files] : users) {
      EXPECT_EQ(files.size(), 1u) << library << " appears in several files of " << stage << ", first "
                                  << *files.begin();
      for (const std::string& file : files) EXPECT_TRUE(file.ends_with(".cpp")) << file << " exposes " << library;
    }
  }
}

TEST(LayerDependencies, EveryFileHasItsLicence) {
  for (const SourceFile& file : code_files())
    EXPECT_TRUE(file.text.starts_with("// SPDX-License-Identifier: BSD-3-Clause\n")) << file.path;
}

}  // namespace
}  // namespace seaglint

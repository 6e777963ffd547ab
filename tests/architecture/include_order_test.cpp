// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/source_files.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Which files include which, and the circles among them.

struct Include {
  std::string file;    // relative to the root
  std::string header;  // as written
  bool system = false;

  bool is_generated() const { return header.starts_with("seaglint_"); }  // below build/
};

std::vector<Include> includes_of(const std::vector<SourceFile>& files) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*([<"])([^">]+)[">])re");
  std::vector<Include> found;
  for (const SourceFile& file : files) {
    for (const std::string& line : lines_of(file.text)) {
      std::smatch match;
      if (line.find('#') != std::string::npos && std::regex_search(line, match, pattern))
        found.push_back({file.path, match[2], match[1] == "<"});
    }
  }
  return found;
}

// A header with the source of the same name.
std::string module_of(const std::string& file) { return file.substr(0, file.rfind('.')); }

using Circle = std::set<std::string>;  // modules that all reach one another

// Strongly connected sets of two and more modules (Tarjan, SIAM J. Comput. 1 (1972) 146).
std::set<Circle> circles_of(const std::vector<Include>& includes) {
  std::map<std::string, std::set<std::string>> graph;
  for (const Include& include : includes)
    if (!include.system && module_of(include.file) != module_of(include.header))
      graph[module_of(include.file)].insert(module_of(include.header));
  std::map<std::string, std::size_t> index, lowest;
  std::vector<std::string> stack;
  std::set<Circle> circles;
  const std::function<void(const std::string&)> visit = [&](const std::string& module) {
    index[module] = lowest[module] = index.size();
    stack.push_back(module);
    for (const std::string& next : graph[module]) {
      if (!index.contains(next)) {
        visit(next);
        lowest[module] = std::min(lowest[module], lowest[next]);
      } else if (std::find(stack.begin(), stack.end(), next) != stack.end()) {
        lowest[module] = std::min(lowest[module], index[next]);
      }
    }
    if (lowest[module] != index[module]) return;
    Circle circle;
    for (bool whole = false; !whole; stack.pop_back()) {
      circle.insert(stack.back());
      whole = stack.back() == module;
    }
    if (circle.size() > 1) circles.insert(circle);
  };
  std::vector<std::string> modules;
  for (const auto& [module, headers] : graph) modules.push_back(module);
  for (const std::string& module : modules)
    if (!index.contains(module)) visit(module);
  return circles;
}

// A file includes only its own stage or room or those before it in the order of folders, and each stage includes a
// third-party library in one source file only.

// Index of a file's folder in the order, -1 when it belongs to none. Rooms precede the stage that they are in.
int place_of(const std::vector<std::string>& folders, const std::string& file) {
  for (std::size_t i = 0; i < folders.size(); ++i)
    if (file.starts_with(folders[i] + "/")) return static_cast<int>(i);
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

// No modules include one another in a circle. A module is a header with the source of the same name.

TEST(IncludeCircles, AreNone) { EXPECT_THAT(circles_of(includes_of(code_files())), testing::IsEmpty()); }

TEST(IncludeCircles, AreFoundBetweenSourcesAndHeaders) {
  const std::set<Circle> circles = circles_of({{"sim/a.cpp", "sim/a.h"},
                                               {"sim/a.cpp", "sim/b.h"},
                                               {"sim/b.h", "sim/c.h"},
                                               {"sim/c.cpp", "sim/a.h"},
                                               {"sim/d.h", "sim/a.h"}});
  EXPECT_THAT(circles, testing::ElementsAre(Circle{"sim/a", "sim/b", "sim/c"}));
}

// The stages that a stage includes, as CMakeLists.txt states them: those of its headers are PUBLIC, those of its
// sources alone PRIVATE.
TEST(StageLinks, AreTheIncludes) {
  const std::vector<std::string> stages = stage_list();
  const auto stage_of = [&](const std::string& file) -> std::string {
    const auto found = std::ranges::find_if(stages, [&](const auto& stage) { return file.starts_with(stage + "/"); });
    return found == stages.end() ? "" : *found;
  };
  std::map<std::string, std::set<std::string>> in_headers, in_sources;
  for (const Include& include : includes_of(code_files())) {
    const std::string from = stage_of(include.file), to = include.system ? "" : stage_of(include.header);
    if (from.empty() || to.empty() || from == to || include.file.starts_with("tools/bindings/")) continue;
    (include.file.ends_with(".h") ? in_headers : in_sources)[from].insert(to);
  }
  for (const std::string& line : split(SEAGLINT_LINKS, ',')) {
    std::vector<std::string> words = split(line, ' ');
    ASSERT_GE(words.size(), 2u);
    std::set<std::string> included = in_headers[words[0]];
    if (words[1] == "PRIVATE") {
      included.clear();
      std::ranges::set_difference(in_sources[words[0]], in_headers[words[0]], std::inserter(included, included.end()));
    }
    std::set<std::string> linked(words.begin() + 2, words.end());
    std::erase_if(linked, [&](const std::string& name) { return std::ranges::find(stages, name) == stages.end(); });
    EXPECT_THAT(linked, testing::ContainerEq(included)) << words[0] << " " << words[1];
  }
}

TEST(StageLinks, EverySourceIsListed) {
  std::map<std::string, std::string> lists;
  for (const SourceFile& file : source_files())
    if (file.path.ends_with("/CMakeLists.txt")) lists[file.path] = file.text;
  int sources = 0;
  for (const SourceFile& file : code_files()) {
    if (!file.path.ends_with(".cpp") || file.is_below("tests") || file.is_below("tools/bindings")) continue;
    const std::size_t top = file.path.find('/');
    std::string name = file.path.substr(top + 1);
    for (const std::string& stage : stage_list())
      if (file.is_below(stage)) name = file.path.substr(stage.size() + 1);
    if (file.path == "classify/cnn/layers.cpp") name = "cnn/layers.cpp";
    ++sources;
    EXPECT_TRUE(
        std::regex_search(lists[file.path.substr(0, top) + "/CMakeLists.txt"], std::regex("[ (]" + name + "[ )\n]")))
        << file.path;
  }
  EXPECT_GT(sources, 100) << "the test finds no sources";
}

}  // namespace
}  // namespace seaglint

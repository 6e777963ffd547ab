// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
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

// Every name that a document uses exists: filters of tests and benchmarks in all files; programs, commands and scripts,
// links to files, stages and rooms, and the places of recipes in documents.

// Everything that is run by name.
struct Runnable {
  std::vector<NamedTest> tests;
  std::map<std::string, std::string> test_programs;  // their folders
  std::set<std::string> benchmarks;
  std::set<std::string> commands;  // of `seaglint`
};

const Runnable& runnable() {
  static const Runnable all = [] {
    Runnable found{all_tests(), {}, benchmarks_in(code_files()), {}};
    for (const std::string& program : split(SEAGLINT_TEST_PROGRAMS, ',')) {
      const std::size_t equals = program.find('=');
      found.test_programs[program.substr(0, equals)] = program.substr(equals + 1);
    }
    static const std::regex command(R"re(\badd_command\(\s*"([a-z-]+)")re");
    for (const SourceFile& file : code_files()) {
      if (!file.is_below("tools")) continue;
      for (std::sregex_iterator match(file.text.begin(), file.text.end(), command), end; match != end; ++match)
        found.commands.insert((*match)[1]);
    }
    return found;
  }();
  return all;
}

// As GoogleTest: `*` any text, `?` any character.
bool matches(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) return name.empty();
  if (pattern[0] == '*') return matches(pattern.substr(1), name) || (!name.empty() && matches(pattern, name.substr(1)));
  return !name.empty() && (pattern[0] == '?' || pattern[0] == name[0]) && matches(pattern.substr(1), name.substr(1));
}

using Faults = std::vector<std::string>;

// `--gtest_filter='AccuracyTables.*:Assets.*:AttitudeSeries.*:DataSetAudit.*:IlluminationByEdge.*:B*'`, behind its
// program or alone, or `... 'A*'` for the program of the line above.
void check_test_filters(const std::string& line, Faults& faults) {
  static const std::regex filter(
      R"re((?:(test_[a-z_]+)\s+)?(?:--gtest_filter=|\.\.\. (?='))('[^']*'|"[^"]*"|[^\s`'"]+))re");
  for (std::sregex_iterator match(line.begin(), line.end(), filter), end; match != end; ++match) {
    const std::string program = (*match)[1];
    std::string value = (*match)[2];
    std::erase_if(value, [](char c) { return c == '\'' || c == '"'; });
    for (const std::string& pattern : split(value.substr(0, value.find('-')), ':')) {
      const bool found = std::any_of(runnable().tests.begin(), runnable().tests.end(), [&](const NamedTest& test) {
        const auto folder = runnable().test_programs.find(program);
        const bool there = program.empty() ||
                           (folder != runnable().test_programs.end() && test.file.starts_with(folder->second + "/"));
        return there && matches(pattern, test.name);
      });
      if (!found) faults.push_back("no test " + pattern + (program.empty() ? "" : " of " + program));
    }
  }
}

// Each alternative of `--benchmark_filter='A|B'`, a regular expression.
void check_benchmark_filters(const std::string& line, Faults& faults) {
  static const std::regex filter(R"re(--benchmark_filter=('[^']*'|"[^"]*"|[^\s`'")]+))re");
  for (std::sregex_iterator match(line.begin(), line.end(), filter), end; match != end; ++match) {
    std::string value = (*match)[1];
    std::erase_if(value, [](char c) { return c == '\'' || c == '"'; });
    for (const std::string& alternative : split(value, '|')) {
      const std::regex expression(alternative);
      const bool found = std::any_of(runnable().benchmarks.begin(), runnable().benchmarks.end(),
                                     [&](const std::string& name) { return std::regex_search(name, expression); });
      if (!found) faults.push_back("no benchmark " + alternative);
    }
  }
}

// Test programs; `seaglint WORD` in code, behind a back quote, a path or the indent of a block.
void check_commands(const std::string& line, Faults& faults) {
  static const std::regex program(R"re((?:build/[a-z]+/|`)(test_[a-z_]+)(?![a-z_.<]))re");
  static const std::regex command(R"re((?:^    .*\b|`|/)seaglint ([a-z][a-z-]*))re");
  for (std::sregex_iterator match(line.begin(), line.end(), program), end; match != end; ++match) {
    const std::string name = (*match)[1];
    if (!runnable().test_programs.contains(name)) faults.push_back("no program " + name);
  }
  for (std::sregex_iterator match(line.begin(), line.end(), command), end; match != end; ++match)
    if (!runnable().commands.contains((*match)[1])) faults.push_back("no command " + (*match)[1].str());
}

// A file or folder of tools/, by its path from the root.
void check_scripts(const std::string& line, Faults& faults) {
  static const std::regex script(
      R"re((?:^|[^A-Za-z0-9_./-])(?:\./)?(tools/[A-Za-z0-9_./-]*[A-Za-z0-9_])(?![A-Za-z0-9_*]))re");
  for (std::sregex_iterator match(line.begin(), line.end(), script), end; match != end; ++match) {
    const std::string path = (*match)[1];
    if (!std::filesystem::exists(std::filesystem::path(SEAGLINT_SOURCE_DIR) / path)) faults.push_back("no " + path);
  }
}

Faults faults_in(const SourceFile& file) {
  Faults all;
  int number = 0;
  for (const std::string& line : lines_of(file.text)) {
    ++number;
    Faults faults;
    if (line.find("_filter=") != std::string::npos || line.find("... '") != std::string::npos) {
      check_test_filters(line, faults);
      check_benchmark_filters(line, faults);
    }
    if (file.path.ends_with(".md")) {
      check_commands(line, faults);
      check_scripts(line, faults);
    }
    for (const std::string& fault : faults) all.push_back(file.path + ":" + std::to_string(number) + ": " + fault);
  }
  return all;
}

TEST(DocumentedNames, FiltersCommandsAndScriptsExist) {
  EXPECT_GT(runnable().benchmarks.size(), 15u);
  EXPECT_GT(runnable().commands.size(), 10u);
  EXPECT_GT(runnable().test_programs.size(), 10u);
  Faults faults;
  for (const SourceFile& file : source_files()) {
    // The changelog contains names that were removed; sources contain filters of the programs that they start.
    if (file.path == "CHANGELOG.md" || file.path.ends_with(".cpp") || file.is_below("tests/architecture")) continue;
    for (const std::string& fault : faults_in(file)) faults.push_back(fault);
  }
  EXPECT_THAT(faults, IsEmpty());
}

TEST(DocumentedNames, ThatDoNotExistAreFound) {
  const auto of = [](const std::string& text) { return faults_in({"x.md", text}); };
  EXPECT_THAT(of("`test_architecture --gtest_filter='DocumentedNames.That*:TestSuites*'`, `./tools/check`,\n"
                 "`build/release/seaglint check scenarios/quick.yaml`, (`... 'TestSuites*'`), tools/"),
              IsEmpty());
  EXPECT_THAT(of("(`--gtest_filter='TestSuites.Nothing*'`)"), ElementsAre(HasSubstr("x.md:1: no test TestSuites.No")));
  EXPECT_THAT(of("`test_core --gtest_filter=TestSuites*`"), ElementsAre(HasSubstr("of test_core")));
  EXPECT_THAT(of("test_attic --gtest_filter=TestSuites*"), ElementsAre(HasSubstr("of test_attic")));
  EXPECT_THAT(of("(`... 'Nothing*'`)"), ElementsAre(HasSubstr("no test Nothing*")));
  EXPECT_THAT(of("`seaglint_bench --benchmark_filter='Map|Nothing'`"), ElementsAre(HasSubstr("no benchmark Nothing")));
  EXPECT_THAT(of("`seaglint simulate`"), ElementsAre(HasSubstr("no command simulate")));
  EXPECT_THAT(of("    srun build/release/seaglint simulate"), ElementsAre(HasSubstr("no command simulate")));
  EXPECT_THAT(of("`build/release/test_attic`"), ElementsAre(HasSubstr("no program test_attic")));
  EXPECT_THAT(of("run ./tools/attic, once"), ElementsAre(HasSubstr("no tools/attic")));
}

// Links: every file that a document links to, relative to its folder.

Faults missing_links(const SourceFile& file) {
  static const std::regex link(R"re(\]\(([^)#\s]+)[^)]*\))re");
  const std::filesystem::path folder = (std::filesystem::path(SEAGLINT_SOURCE_DIR) / file.path).parent_path();
  Faults faults;
  for (std::sregex_iterator match(file.text.begin(), file.text.end(), link), end; match != end; ++match) {
    const std::string target = (*match)[1];
    if (target.find("://") == std::string::npos && !std::filesystem::exists(folder / target))
      faults.push_back(file.path + ": no " + target);
  }
  return faults;
}

TEST(DocumentedNames, FilesOfLinksExist) {
  Faults faults;
  for (const SourceFile& file : source_files()) {
    if (!file.path.ends_with(".md")) continue;
    for (const std::string& fault : missing_links(file)) faults.push_back(fault);
  }
  EXPECT_THAT(faults, IsEmpty());
  EXPECT_THAT(missing_links({"tests/x.md", "[a](README.md#b), [c](../README.md), [d](https://e.f), ![g](h.png)"}),
              ElementsAre("tests/x.md: no h.png"));
}

// The tree in CONTRIBUTING.md: a row for each stage, or for several without rooms, in their order; rooms in theirs.

// Text of a row's last cell, links by their words.
std::string last_cell(const std::string& row) {
  static const std::regex link(R"re(\[([^\]]*)\]\([^)]*\))re");
  const std::size_t end = row.rfind('|'), begin = row.rfind('|', end - 1) + 1;
  std::string cell = std::regex_replace(row.substr(begin, end - begin), link, "$1");
  const std::size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
  return first == std::string::npos ? "" : cell.substr(first, last - first + 1);
}

TEST(DocumentedTree, HasTheStagesAndTheirRooms) {
  const auto file = std::ranges::find(source_files(), "CONTRIBUTING.md", &SourceFile::path);
  ASSERT_NE(file, source_files().end());
  std::size_t place = 0;
  for (const std::string& stage : stage_list()) {
    const std::size_t found = file->text.find("](" + stage + "/README.md)", place);
    ASSERT_NE(found, std::string::npos) << stage << " has no row in its place";
    place = found;
    std::string rooms;
    for (const std::string& room : room_list()) {
      if (room.starts_with(stage + "/")) rooms += (rooms.empty() ? "" : ", ") + room.substr(stage.size() + 1);
    }
    const std::size_t begin = file->text.rfind('\n', place) + 1;
    EXPECT_EQ(last_cell(file->text.substr(begin, file->text.find('\n', place) - begin)), rooms) << stage;
  }
}

// Recipes of CONTRIBUTING.md: numbered lines that name files, and in the text behind them names that stand in these.

// The texts of the files whose paths a line names between back quotes; other quoted words without blanks and dashes.
struct RecipeLine {
  std::vector<std::string> paths, names;
};

RecipeLine recipe_line(const std::string& line) {
  static const std::regex quoted("`([^`]+)`");
  RecipeLine found;
  for (std::sregex_iterator match(line.begin(), line.end(), quoted), end; match != end; ++match) {
    const std::string item = (*match)[1];
    if (item.find(' ') != std::string::npos || item.starts_with("-")) continue;  // commands, options
    (item.find('/') != std::string::npos ? found.paths : found.names).push_back(item);
  }
  return found;
}

Faults recipe_faults(const std::string& text) {
  static const std::regex step(R"re([0-9]+\. .*)re");
  Faults faults;
  bool in_recipes = false;
  for (const std::string& line : lines_of(text)) {
    if (line.starts_with("## ")) in_recipes = line == "## Recipes";
    if (!in_recipes || !std::regex_match(line, step)) continue;
    const RecipeLine named = recipe_line(line);
    if (named.paths.empty()) faults.push_back("no place: " + line);
    std::string texts;
    for (const std::string& path : named.paths) {
      const std::filesystem::path file = std::filesystem::path(SEAGLINT_SOURCE_DIR) / path;
      if (!std::filesystem::exists(file)) faults.push_back("no " + path);
      if (!std::filesystem::is_regular_file(file)) continue;
      std::ifstream stream(file, std::ios::binary);
      texts.append(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    }
    for (const std::string& name : named.names) {
      const std::regex word("(^|[^A-Za-z0-9_])" + name + "($|[^A-Za-z0-9_])");
      if (!std::regex_search(texts, word)) faults.push_back("no " + name + ": " + line);
    }
  }
  return faults;
}

TEST(Recipes, NameFilesAndWhatStandsInThem) {
  for (const SourceFile& file : source_files()) {
    if (file.path != "CONTRIBUTING.md") continue;
    EXPECT_GT(std::ranges::count(file.text, '\n'), 50) << "the test finds no recipes";
    EXPECT_THAT(recipe_faults(file.text), IsEmpty());
  }
}

TEST(Recipes, ThatNameWhatIsNotThereAreFound) {
  EXPECT_THAT(
      recipe_faults("1. `no/file`: before the recipes\n## Recipes\n1. `tools/main.cpp`: `main` and `--help`\n"
                    "2. `tools/attic.cpp`: `main`\n3. `run_command_line`\n4. `tools/main.cpp`: `mai`\n"),
      ElementsAre("no tools/attic.cpp", "no main: 2. `tools/attic.cpp`: `main`", "no place: 3. `run_command_line`",
                  "no run_command_line: 3. `run_command_line`", "no mai: 4. `tools/main.cpp`: `mai`"));
}

// A filter by a suite's name selects the tests of one file.

std::vector<std::string> in_several_files(const std::vector<NamedTest>& tests) {
  std::map<std::string, std::set<std::string>> files;
  for (const NamedTest& test : tests) files[test.suite].insert(test.file);
  std::vector<std::string> found;
  for (const auto& [suite, of] : files) {
    if (of.size() < 2) continue;
    found.push_back(suite + ":");
    for (const std::string& file : of) found.back() += " " + file;
  }
  return found;
}

TEST(TestSuites, AreInOneFileEach) {
  const std::vector<NamedTest> tests = all_tests();
  EXPECT_GT(tests.size(), 800u) << "the test finds no tests";
  EXPECT_THAT(in_several_files(tests), IsEmpty());
}

TEST(TestSuites, OfOneNameInSeveralFilesAreFound) {
  EXPECT_THAT(in_several_files({{"A", "A.x", "a"}, {"A", "A.y", "a"}, {"B", "B.x", "a"}, {"A", "A.z", "b"}}),
              ElementsAre("A: a b"));
}

}  // namespace
}  // namespace seaglint

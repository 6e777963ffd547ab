// SPDX-License-Identifier: BSD-3-Clause
// Text reaches the terminal through print_out(), print_text() and print_error() alone, which escape what a terminal
// could take for a command.
#include <gmock/gmock.h>

#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/source_files.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The functions themselves, and the progress bar, whose own text moves the cursor.
bool may_print(const std::string& file) {
  static const std::set<std::string> files{"sim/core/process/printable.cpp", "sim/core/process/progress.cpp"};
  return files.contains(file) || file.starts_with("tests/");
}

// "FILE:LINE: NAME" for every name of a function or stream that prints. `print` is that of fmt.
std::vector<std::string> prints_in(const SourceFile& file) {
  static const std::set<std::string> names{"cout",    "cerr",     "clog",    "wcout", "wcerr",  "printf", "fprintf",
                                           "vprintf", "vfprintf", "dprintf", "puts",  "fputs",  "putc",   "fputc",
                                           "putchar", "perror",   "psignal", "print", "println"};
  std::vector<std::string> found;
  int number = 0;
  for (const std::string& line : lines_of(code_of(file.text))) {
    ++number;
    static const std::regex word(R"([A-Za-z_]\w*)");
    for (std::sregex_iterator match(line.begin(), line.end(), word), end; match != end; ++match)
      if (names.contains(match->str()) && !line.starts_with("#"))
        found.push_back(file.path + ":" + std::to_string(number) + ": " + match->str());
  }
  return found;
}

TEST(TerminalOutput, IsPrintedByTheFunctionsThatEscapeIt) {
  std::vector<std::string> found;
  int sources = 0;
  for (const SourceFile& file : code_files()) {
    if (may_print(file.path)) continue;
    ++sources;
    for (const std::string& place : prints_in(file)) found.push_back(place);
  }
  EXPECT_GT(sources, 200) << "the test finds no sources";
  EXPECT_THAT(found, IsEmpty());
}

TEST(TerminalOutput, ByOtherFunctionsIsFound) {
  const SourceFile file{
      "tools/a.cpp", "// std::cout\nvoid f() {\n  fmt::print(\"cerr\");\n  std::cerr << 1;\n  print_out(\"x\");\n}\n"};
  EXPECT_THAT(prints_in(file), ElementsAre("tools/a.cpp:3: print", "tools/a.cpp:4: cerr"));
}

}  // namespace
}  // namespace seaglint

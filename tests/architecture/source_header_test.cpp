// SPDX-License-Identifier: BSD-3-Clause
// Every source has a header of the same stem in its folder, in which its declarations are found.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/architecture/source_files.h"

namespace seaglint {
namespace {

// The program itself, the commands, all of which tools/cli/command_line.h declares, and the Python module with its
// parts, which tools/bindings/bindings.h declares.
bool may_have_no_header(const std::string& source) {
  return source == "tools/main.cpp" || source.starts_with("tools/cli/command_") ||
         source == "tools/bindings/module.cpp" ||
         (source.starts_with("tools/bindings/") && source.ends_with("_binding.cpp"));
}

TEST(SourceHeader, EverySourceHasAHeaderOfItsName) {
  std::set<std::string> files;
  for (const SourceFile& file : code_files()) files.insert(file.path);
  int sources = 0;
  for (const std::string& file : files) {
    if (!file.ends_with(".cpp") || file.starts_with("tests/") || may_have_no_header(file)) continue;
    ++sources;
    EXPECT_TRUE(files.contains(file.substr(0, file.size() - 4) + ".h")) << file;
  }
  EXPECT_GT(sources, 100) << "the test finds no sources";
}

}  // namespace
}  // namespace seaglint

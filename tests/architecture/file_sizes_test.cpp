// SPDX-License-Identifier: BSD-3-Clause
// Limits of the number of lines of a file and of the number of files in a folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "tests/architecture/source_files.h"

namespace seaglint {
namespace {

constexpr int kLongestHeader = 250, kLongestSource = 400;  // lines
constexpr int kMaxFiles = 30;                              // in a folder, without those of its sub-folders

TEST(FileSizes, HeadersHaveAtMost250LinesAndSources400) {
  std::set<std::string> found;
  for (const SourceFile& file : code_files()) {
    const auto lines = std::count(file.text.begin(), file.text.end(), '\n');
    if (lines > (file.path.ends_with(".h") ? kLongestHeader : kLongestSource)) found.insert(file.path);
  }
  EXPECT_THAT(found, testing::IsEmpty());
}

TEST(FileSizes, FoldersHaveAtMost30Files) {
  namespace fs = std::filesystem;
  const fs::path root = SEAGLINT_SOURCE_DIR;
  std::map<std::string, int> files;
  for (const char* top : {"assets", "scenarios", "sim", "radar", "classify", "tools", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.is_regular_file()) ++files[fs::relative(entry.path().parent_path(), root).string()];
    }
  }
  EXPECT_GT(files["tests/architecture"], 5) << "the test counts no files";
  std::set<std::string> found;
  for (const auto& [folder, count] : files) {
    if (count > kMaxFiles && !folder.starts_with("tests/reference")) found.insert(folder);
  }
  EXPECT_THAT(found, testing::IsEmpty());
}

}  // namespace
}  // namespace seaglint

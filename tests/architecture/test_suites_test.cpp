// SPDX-License-Identifier: BSD-3-Clause
// A filter by a suite's name selects the tests of one file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/test_names.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

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

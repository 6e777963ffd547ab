// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The names of tests and benchmarks, as their macros give them.

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/cpp_tokens.h"
#include "tests/architecture/source_files.h"

namespace seaglint {

struct NamedTest {
  std::string suite;
  std::string name;  // as in a filter: SUITE.NAME, of an instantiated one INSTANCE/SUITE.NAME/0
  std::string file;
};

// The tests of one file; instantiations are in the file of their tests.
inline std::vector<NamedTest> tests_in(const SourceFile& file) {
  static const std::set<std::string> kMacros = {"TEST", "TEST_F", "TEST_P", "TYPED_TEST"};
  const std::vector<Token> tokens = tokens_of(file.text);
  std::vector<NamedTest> tests;
  for (std::size_t i = 0; i + 5 < tokens.size(); ++i) {
    if (!kMacros.contains(tokens[i].text) || tokens[i + 1].text != "(" || tokens[i + 3].text != ",") continue;
    const std::string &suite = tokens[i + 2].text, name = suite + "." + tokens[i + 4].text;
    if (tokens[i].text != "TEST_P") {
      tests.push_back({suite, name, file.path});
      continue;
    }
    for (std::size_t k = 0; k + 4 < tokens.size(); ++k) {
      if (tokens[k].text != "INSTANTIATE_TEST_SUITE_P") continue;
      const bool nameless = tokens[k + 2].text == ",";
      if (tokens[k + (nameless ? 3 : 4)].text == suite)
        tests.push_back({suite, (nameless ? "" : tokens[k + 2].text + "/") + name + "/0", file.path});
    }
  }
  return tests;
}

inline std::vector<NamedTest> all_tests() {
  std::vector<NamedTest> all;
  for (const SourceFile& file : code_files()) {
    if (!file.path.ends_with("_test.cpp")) continue;
    for (NamedTest& test : tests_in(file)) all.push_back(std::move(test));
  }
  return all;
}

inline std::set<std::string> benchmarks_in(const std::vector<SourceFile>& files) {
  std::set<std::string> names;
  for (const SourceFile& file : files) {
    if (!file.path.ends_with("_bench.cpp")) continue;
    const std::vector<Token> tokens = tokens_of(file.text);
    for (std::size_t i = 0; i + 2 < tokens.size(); ++i) {
      if (tokens[i].text.starts_with("BENCHMARK") && tokens[i + 1].text == "(") names.insert(tokens[i + 2].text);
    }
  }
  return names;
}

}  // namespace seaglint

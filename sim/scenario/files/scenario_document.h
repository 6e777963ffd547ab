// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A scenario's YAML tree, and where its complaints point.

#include <string>
#include <vector>

#include "sim/scenario/files/document.h"

namespace seaglint {

// A scenario's tree with the overrides applied, and what its complaints need.
struct ScenarioDocument {
  std::string file_name;
  std::vector<std::string> override_paths;
  YamlNode root;

  // "file:line:col: key.path" or "--set path: key.path".
  std::string place(const Location& location, const std::string& key_path) const;
  // The same of a key path, or of its closest parent where it is not in the file.
  std::string place_of(const std::string& key_path) const;

  // Throws InputError "file:line:col: key.path: what" or "--set path: key.path: what".
  [[noreturn]] void fail(const Location& location, const std::string& key_path, const std::string& what) const;
  // The same, at the place of a key path, or of its closest parent where it is not in the file. A value that is there
  // is quoted.
  [[noreturn]] void fail_at(const std::string& key_path, const std::string& what) const;
};

// "a.b.c" into its keys.
std::vector<std::string> split_path(const std::string& key_path);

}  // namespace seaglint

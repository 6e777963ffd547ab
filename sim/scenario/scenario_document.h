// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The YAML tree of a scenario with overrides, and the places that messages about it name.

#include <string>
#include <vector>

#include "sim/scenario/document.h"

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

// `key.path=value` of --set; the value is YAML and is checked like the file.
struct Override {
  std::string key_path;
  std::string value;
};

// Puts an override's value into the tree; maps on the way that do not exist yet are made, so that reading can complain
// about them.
void apply_override(ScenarioDocument& document, const Override& override_value);

}  // namespace seaglint

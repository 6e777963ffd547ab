// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// From the YAML tree to the structs: what each field accepts, and where the complaint about it points.

#include <functional>
#include <string>
#include <vector>

#include "sim/scenario/document.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

class FieldVisitor;

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

// Puts an override's value into the tree; maps on the way that do not exist yet are made, so that reading can complain
// about them.
void apply_override(ScenarioDocument& document, const Override& override_value);

// Reads every field. Throws InputError for unknown and duplicate keys, missing required ones, wrong types and values
// out of bounds.
Scenario read_fields(const ScenarioDocument& document);
// The same for another kind of file.
void read_fields(const ScenarioDocument& document, const std::function<void(FieldVisitor&)>& fields);

}  // namespace seaglint

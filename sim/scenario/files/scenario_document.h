// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// YAML tree of a scenario, with positions for error messages.

#include <string>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/scenario/files/document.h"

namespace seaglint {

// An error at a place of the document.
class PlacedError : public InputError {
 public:
  PlacedError(const Location& at, const std::string& message) : InputError(message), location(at) {}
  Location location;
};

// YAML tree of a scenario with the overrides applied.
struct ScenarioDocument {
  std::string file_name;
  std::vector<std::string> override_paths;
  YamlNode root;
  std::vector<std::string> drawn_keys = {};  // that have drawn values in `root`

  // Whether a key is drawn: keys that belong to another of its values are no contradictions.
  bool draws(const std::string& key_path) const;

  // "file:line:col: key.path" or "--set path: key.path".
  std::string place(const Location& location, const std::string& key_path) const;
  // The same for a key path, or for its closest parent in the file.
  std::string place_of(const std::string& key_path) const;
  Location location_of(const std::string& key_path) const;

  // Throws PlacedError "file:line:col: key.path: what" or "--set path: key.path: what".
  [[noreturn]] void fail(const Location& location, const std::string& key_path, const std::string& what) const;
  // The same at the position of a key path, or of its closest parent in the file; quotes the value if present.
  [[noreturn]] void fail_at(const std::string& key_path, const std::string& what) const;
};

// Splits "a.b.c" into its keys.
std::vector<std::string> split_path(const std::string& key_path);

}  // namespace seaglint

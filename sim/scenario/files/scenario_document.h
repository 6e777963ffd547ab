// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// YAML tree of a scenario: positions in messages, overrides of --set in it, and the errors that are collected while it
// is read, so that all mistakes of a file are reported at once.

#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
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

  // Whether a key is in the file.
  bool has(const std::string& key_path) const;

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

// Keys of a section that state one quantity, of which at most one is given. --set of one replaces another.
struct Alternatives {
  const char* section;
  std::string_view keys[5];  // empty: fewer
};
inline constexpr std::string_view kScatterDiagram = "scatter_diagram";  // gives heights and periods
inline constexpr Alternatives kAlternatives[] = {
    {"sea", {"peak_period_s", "energy_period_s", "zero_crossing_period_s", "steepness", kScatterDiagram}},
    {"sea", {"significant_wave_height_m", kScatterDiagram}},
    {"sea", {"propagation_deg", "coming_from_deg"}},
    {"sea.swell", {"peak_period_s", "energy_period_s", "zero_crossing_period_s"}},
    {"sea.swell", {"propagation_deg", "coming_from_deg"}},
};

// `key.path=value` of --set; the value is YAML and is checked like the file.
struct Override {
  std::string key_path;
  std::string value;
};

// Inserts an override into the tree. Missing maps on the path are created, so that the reader reports unknown keys.
// The alternatives of the key are removed.
void apply_override(ScenarioDocument& document, const Override& override_value);

// Each error makes keys unusable: no check that needs one of them reports what follows from the same mistake. An error
// of the key `seaglint`, the version of the format, is the only one that is reported.
class ErrorList {
 public:
  using Keys = std::initializer_list<std::string_view>;

  // More errors are counted only.
  static constexpr std::size_t kMost = 20;

  // The document gives the places of errors that have none of their own; it outlives the list.
  explicit ErrorList(const ScenarioDocument& document) : document_(document) {}

  // Calls work() and records the InputError that it throws; false then. `keys`: key paths that the error makes
  // unusable.
  template <typename Work>
  bool attempt(Keys keys, const Work& work) {
    try {
      work();
      return true;
    } catch (const InputError& error) {
      add(error, keys);
      return false;
    }
  }

  // The same, not at all where one of the keys, those above or those below it are unusable; false then.
  template <typename Work>
  bool check(Keys keys, const Work& work) {
    for (const std::string_view key : keys) {
      if (concerns(key)) return false;
    }
    return attempt(keys, work);
  }

  void add(const InputError& error, Keys keys);
  // An error at a place, without a message beyond kMost errors.
  bool is_full() const { return errors_.size() >= kMost; }
  void count_further(Keys keys);
  // Makes a key unusable without an error of its own: that of another key causes it.
  void exclude(const std::string& key_path) { unusable_.insert(key_path); }

  bool is_empty() const { return errors_.empty(); }
  bool is_unusable(std::string_view key_path) const;  // itself or a key below it
  bool concerns(std::string_view key_path) const;     // the same, or a map that contains it

  // The messages in the order of their places, with `end` behind each, and the number of those that were only counted.
  std::vector<std::string> messages(const std::string& end = {}) const;
  // Throws all as one InputError if there are any.
  void throw_if_any(const std::string& end = {}) const;

 private:
  struct Entry {
    Location location;
    std::string message;
    std::string key;
  };

  const ScenarioDocument& document_;
  std::vector<Entry> errors_;
  std::size_t further_ = 0;
  std::set<std::string, std::less<>> unusable_;  // key paths; "" is the whole document
};

}  // namespace seaglint

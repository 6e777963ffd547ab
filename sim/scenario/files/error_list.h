// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Errors of a document, collected while it is read, so that all mistakes of a file are reported at once.

#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/scenario/files/scenario_document.h"

namespace seaglint {

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

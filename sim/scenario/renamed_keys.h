// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Keys and values of scenarios of earlier versions: what each is called now. None is read under its old name.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace seaglint {

struct RenamedKey {
  std::string_view path;                // of the old key; * is any one name
  std::string_view now;                 // the new key, in the same section
  std::string_view note{};              // what else has changed
  double (*convert)(double) = nullptr;  // the new value of an old number, where that differs
};

struct RenamedValue {
  std::string_view path;  // of the key
  std::string_view value, now;
};

std::span<const RenamedKey> renamed_keys();
std::span<const RenamedValue> renamed_values();

// "renamed to NEW, note: write NEW: 30" for the path of an old key and its value as written; nothing for other keys.
std::optional<std::string> renamed_key(std::string_view path, std::string_view value);

// The new name of an old value of a key; nothing for other values.
std::optional<std::string_view> renamed_value(std::string_view path, std::string_view value);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A YAML text as a small tree that knows where each value stands; hides yaml-cpp.

#include <string>
#include <string_view>
#include <vector>

namespace seaglint {

struct Location {
  int line = 1;             // from 1
  int column = 1;           // from 1
  int override_index = -1;  // which --set it comes from; -1 = the file
};

struct YamlEntry;

struct YamlNode {
  enum class Kind { kNull, kScalar, kList, kMap };
  Kind kind = Kind::kNull;
  Location location;
  std::string text;                // of a scalar
  bool quoted = false;             // a scalar in quotes
  std::vector<YamlNode> items;     // of a list
  std::vector<YamlEntry> entries;  // of a map, in the order of the text, duplicates included
  // The value of the first entry with this key, or nullptr.
  const YamlNode* find(std::string_view key) const;
  YamlNode* find(std::string_view key);
};

struct YamlEntry {
  std::string key;
  Location location;  // of the key
  YamlNode value;
};

// Limits that no scenario meets and every hostile file does.
inline constexpr std::size_t kMaxYamlBytes = 10'000'000;
inline constexpr std::size_t kMaxYamlNodes = 300'000;
inline constexpr int kMaxYamlDepth = 32;

// Parses one document. Aliases are replaced by copies of what they name. Throws InputError "name:line:col: ..." for
// what is not YAML, not text in UTF-8, too large or too deep, for tags, for keys that are not plain text, and for more
// than one document.
YamlNode parse_yaml(const std::string& text, const std::string& name);

}  // namespace seaglint

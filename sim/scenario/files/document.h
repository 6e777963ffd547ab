// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// YAML text as a tree whose nodes have their positions in the file; encapsulates yaml-cpp.

#include <string>
#include <string_view>
#include <vector>

namespace seaglint {

struct Location {
  int line = 1;             // from 1
  int column = 1;           // from 1
  int override_index = -1;  // index of the --set option; -1 = the file
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

// Size limits, far above those of any scenario, against hostile files. Indicators are the characters , : [ ] { } & * !
// " and ' wherever they stand: yaml-cpp holds the tokens of a whole line or bracket at once, some 200 bytes each.
inline constexpr std::size_t kMaxYamlBytes = 4'000'000;
inline constexpr std::size_t kMaxYamlIndicators = 500'000;
inline constexpr std::size_t kMaxYamlNodes = 300'000;
inline constexpr int kMaxYamlDepth = 32;

// Parses one document. Aliases are replaced by copies, and a merge key `<<` by the entries of
// its maps that the map itself lacks. Throws InputError "name:line:col: ..." for invalid YAML, text
// that is not UTF-8, excessive size or depth, tags, keys that are not plain text, and more than one document.
YamlNode parse_yaml(const std::string& text, const std::string& name);

}  // namespace seaglint

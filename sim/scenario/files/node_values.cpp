// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/node_values.h"

#include <algorithm>

#include "sim/core/text/number.h"
#include "sim/core/text/shown.h"

namespace seaglint {

std::string value_text(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kNull: return "no value";
    case YamlNode::Kind::kList: return "a list";
    case YamlNode::Kind::kMap: return "a map";
    case YamlNode::Kind::kScalar: break;
  }
  std::string text = node.text;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return "value " + in_quotes(text);
}

bool is_plain(const YamlNode& node) { return node.kind == YamlNode::Kind::kScalar && !node.quoted; }

std::optional<std::int64_t> integer_of(const YamlNode& node) {
  return is_plain(node) ? parse_integer(node.text) : std::nullopt;
}

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

}  // namespace seaglint

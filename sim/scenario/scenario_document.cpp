// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/scenario_document.h"

#include <fmt/format.h>

#include "sim/core/error.h"
#include "sim/core/number.h"
#include "sim/core/utf8.h"

namespace seaglint {

namespace {

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> keys;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    keys.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return keys;
}

// The node of a key path, or its closest parent.
struct Closest {
  const YamlNode* node;
  bool itself;
};

Closest closest(const YamlNode& root, const std::string& key_path) {
  const YamlNode* node = &root;
  for (const std::string& key : split_path(key_path)) {
    const YamlNode* child = node->find(key);
    if (child == nullptr) return {node, false};
    node = child;
  }
  return {node, true};
}

void require_utf8(const Override& override_value) {
  const std::string text = override_value.key_path + "=" + override_value.value;
  const std::size_t utf8 = utf8_prefix(text);
  if (utf8 < text.size()) {
    throw InputError(fmt::format("--set {}: byte 0x{:02x}: must be UTF-8", text.substr(0, utf8),
                                 static_cast<unsigned char>(text[utf8])));
  }
}

void mark_as_override(YamlNode& node, int index) {
  node.location.override_index = index;
  for (YamlNode& item : node.items) mark_as_override(item, index);
  for (YamlEntry& entry : node.entries) {
    entry.location.override_index = index;
    mark_as_override(entry.value, index);
  }
}

}  // namespace

std::string ScenarioDocument::place(const Location& location, const std::string& key_path) const {
  if (location.override_index < 0)
    return fmt::format("{}:{}:{}: {}", file_name, location.line, location.column, key_path);
  const std::string& override_path = override_paths[static_cast<std::size_t>(location.override_index)];
  return key_path == override_path ? "--set " + override_path : fmt::format("--set {}: {}", override_path, key_path);
}

std::string ScenarioDocument::place_of(const std::string& key_path) const {
  return place(closest(root, key_path).node->location, key_path);
}

void ScenarioDocument::fail(const Location& location, const std::string& key_path, const std::string& what) const {
  throw InputError(fmt::format("{}: {}", place(location, key_path), what));
}

void ScenarioDocument::fail_at(const std::string& key_path, const std::string& what) const {
  const auto [node, itself] = closest(root, key_path);
  const bool quotable = itself && node->kind == YamlNode::Kind::kScalar;
  fail(node->location, key_path, quotable ? fmt::format("value '{}': {}", node->text, what) : what);
}

void apply_override(ScenarioDocument& document, const Override& override_value) {
  require_utf8(override_value);
  const std::string name = "--set " + override_value.key_path;
  const int index = static_cast<int>(document.override_paths.size());
  document.override_paths.push_back(override_value.key_path);
  YamlNode value;
  try {
    value = parse_yaml(override_value.value, name);
  } catch (const InputError&) {
    throw InputError(fmt::format("{}: value '{}': not valid YAML", name, override_value.value));
  }
  mark_as_override(value, index);

  YamlNode* node = &document.root;
  for (const std::string& key : split_path(override_value.key_path)) {
    if (key.empty()) throw InputError(fmt::format("{}: must be key.path=value", name));
    if (node->kind == YamlNode::Kind::kList) {
      const std::optional<double> position = parse_number(key);
      const auto count = static_cast<double>(node->items.size());
      if (!position || *position < 0 || *position >= count ||
          *position != static_cast<double>(static_cast<int>(*position))) {
        throw InputError(fmt::format("{}: '{}' must be the number of an item, from 0 to {}", name, key, count - 1));
      }
      node = &node->items[static_cast<std::size_t>(*position)];
      continue;
    }
    if (node->kind == YamlNode::Kind::kScalar)
      throw InputError(fmt::format("{}: there is nothing below the value '{}'", name, node->text));
    YamlNode* child = node->find(key);
    if (child == nullptr) {
      Location location;
      location.override_index = index;
      node->kind = YamlNode::Kind::kMap;
      node->entries.push_back({key, location, {}});
      node->entries.back().value.location = location;
      child = &node->entries.back().value;
    }
    node = child;
  }
  *node = std::move(value);
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "sim/core/error.h"
#include "sim/core/number.h"
#include "sim/scenario/reader.h"

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

void mark_as_override(YamlNode& node, int index) {
  node.location.override_index = index;
  for (YamlNode& item : node.items) mark_as_override(item, index);
  for (YamlEntry& entry : node.entries) {
    entry.location.override_index = index;
    mark_as_override(entry.value, index);
  }
}

}  // namespace

void ScenarioDocument::fail(const Location& location, const std::string& key_path, const std::string& what) const {
  std::string place = fmt::format("{}:{}:{}", file_name, location.line, location.column);
  std::string path = key_path;
  if (location.override_index >= 0) {
    const std::string& override_path = override_paths[static_cast<std::size_t>(location.override_index)];
    place = "--set " + override_path;
    if (path == override_path) path.clear();
  }
  throw InputError(fmt::format("{}: {}{}{}", place, path, path.empty() ? "" : ": ", what));
}

void ScenarioDocument::fail_at(const std::string& key_path, const std::string& what) const {
  const YamlNode* node = &root;
  bool found = true;
  for (const std::string& key : split_path(key_path)) {
    const YamlNode* child = node->find(key);
    found = child != nullptr;
    if (!found) break;
    node = child;
  }
  const bool quotable = found && node->kind == YamlNode::Kind::kScalar;
  fail(node->location, key_path, quotable ? fmt::format("value '{}': {}", node->text, what) : what);
}

void apply_override(ScenarioDocument& document, const Override& override_value) {
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

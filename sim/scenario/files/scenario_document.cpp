// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/scenario_document.h"

#include <fmt/format.h>

#include <algorithm>

namespace seaglint {

namespace {

// The node of a key path, or its closest parent.
struct Closest {
  const YamlNode* node;
  bool itself;
};

Closest closest(const YamlNode& root, const std::string& key_path) {
  const YamlNode* node = &root;
  for (std::size_t begin = 0; begin <= key_path.size();) {
    // A key may have dots of its own, as a column of learning.split.hold_out.
    if (const YamlNode* last = node->find(key_path.substr(begin))) return {last, true};
    const std::size_t end = std::min(key_path.find('.', begin), key_path.size());
    const YamlNode* child = node->find(key_path.substr(begin, end - begin));
    if (child == nullptr) return {node, false};
    node = child;
    begin = end + 1;
  }
  return {node, true};
}

}  // namespace

std::vector<std::string> split_path(const std::string& key_path) {
  std::vector<std::string> keys;
  for (std::size_t begin = 0; begin <= key_path.size();) {
    const std::size_t end = std::min(key_path.find('.', begin), key_path.size());
    keys.push_back(key_path.substr(begin, end - begin));
    begin = end + 1;
  }
  return keys;
}

bool ScenarioDocument::draws(const std::string& key_path) const {
  return std::ranges::find(drawn_keys, key_path) != drawn_keys.end();
}

std::string ScenarioDocument::place(const Location& location, const std::string& key_path) const {
  if (location.override_index < 0)
    return fmt::format("{}:{}:{}: {}", file_name, location.line, location.column, key_path);
  const std::string& override_path = override_paths[static_cast<std::size_t>(location.override_index)];
  return key_path == override_path ? "--set " + override_path : fmt::format("--set {}: {}", override_path, key_path);
}

Location ScenarioDocument::location_of(const std::string& key_path) const {
  return closest(root, key_path).node->location;
}

std::string ScenarioDocument::place_of(const std::string& key_path) const {
  return place(location_of(key_path), key_path);
}

void ScenarioDocument::fail(const Location& location, const std::string& key_path, const std::string& what) const {
  throw PlacedError(location, fmt::format("{}: {}", place(location, key_path), what));
}

void ScenarioDocument::fail_at(const std::string& key_path, const std::string& what) const {
  const auto [node, itself] = closest(root, key_path);
  const bool quotable = itself && node->kind == YamlNode::Kind::kScalar;
  fail(node->location, key_path, quotable ? fmt::format("value '{}': {}", node->text, what) : what);
}

}  // namespace seaglint

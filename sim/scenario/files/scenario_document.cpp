// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/scenario_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/words.h"

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

bool ScenarioDocument::has(const std::string& key_path) const { return closest(root, key_path).itself; }

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

namespace {

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

// Removes the alternatives of a key from the section that contains it.
void remove_alternatives(YamlNode& section, const std::string& section_path, const std::string& key) {
  for (const Alternatives& group : kAlternatives) {
    const auto is_of_group = [&](const std::string& name) {
      return std::ranges::find(group.keys, name) != std::end(group.keys);
    };
    if (section_path != group.section || !is_of_group(key)) continue;
    std::erase_if(section.entries, [&](const YamlEntry& entry) { return entry.key != key && is_of_group(entry.key); });
  }
}

}  // namespace

void apply_override(ScenarioDocument& document, const Override& override_value) {
  require_utf8(override_value);
  const std::string name = "--set " + override_value.key_path;
  const std::vector<std::string> keys = split_path(override_value.key_path);
  for (const std::string& key : keys) {
    if (key.empty()) throw InputError(fmt::format("{}: must be key.path=value", name));
  }
  const int index = static_cast<int>(document.override_paths.size());
  document.override_paths.push_back(override_value.key_path);
  YamlNode value;
  try {
    value = parse_yaml(override_value.value, name);
  } catch (const InputError&) {
    throw InputError(fmt::format("{}: value {}: not valid YAML", name, in_quotes(override_value.value)));
  }
  mark_as_override(value, index);

  YamlNode* node = &document.root;
  for (const std::string& key : keys) {
    if (node->kind == YamlNode::Kind::kList) {
      const std::optional<std::uint64_t> position = parse_natural(key);
      if (!position || *position >= node->items.size()) {
        throw InputError(fmt::format("{}: {} must be the number of an item, from 0 to {}", name, in_quotes(key),
                                     node->items.size() - 1));
      }
      node = &node->items[static_cast<std::size_t>(*position)];
      continue;
    }
    if (node->kind == YamlNode::Kind::kScalar)
      throw InputError(fmt::format("{}: there is nothing below the value {}", name, in_quotes(node->text)));
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
  const std::size_t dot = override_value.key_path.rfind('.');
  if (dot == std::string::npos) return;
  const std::string section_path = override_value.key_path.substr(0, dot);
  YamlNode* section = &document.root;
  for (const std::string& key : split_path(section_path)) {
    if (section != nullptr) section = section->find(key);
  }
  if (section != nullptr) remove_alternatives(*section, section_path, override_value.key_path.substr(dot + 1));
}

constexpr const char* kVersionKey = "seaglint";

void ErrorList::add(const InputError& error, Keys keys) {
  if (is_full()) return count_further(keys);
  const auto* placed = dynamic_cast<const PlacedError*>(&error);
  const std::string first = keys.size() == 0 ? "" : std::string(*keys.begin());
  const Location location = placed != nullptr ? placed->location : document_.location_of(first);
  for (std::string& message : messages_of(error)) errors_.push_back({location, std::move(message), first});
  unusable_.insert(keys.begin(), keys.end());
}

void ErrorList::count_further(Keys keys) {
  ++further_;
  unusable_.insert(keys.begin(), keys.end());
}

bool ErrorList::is_unusable(std::string_view key_path) const {
  if (unusable_.empty()) return false;
  if (key_path.empty() || unusable_.contains(key_path)) return true;
  const std::string below = std::string(key_path) + ".";
  const auto next = unusable_.lower_bound(below);
  return next != unusable_.end() && next->starts_with(below);
}

bool ErrorList::concerns(std::string_view key_path) const {
  if (unusable_.empty()) return false;
  if (unusable_.contains("") || is_unusable(key_path)) return true;
  for (std::size_t dot = key_path.find('.'); dot != std::string_view::npos; dot = key_path.find('.', dot + 1)) {
    if (unusable_.contains(key_path.substr(0, dot))) return true;
  }
  return false;
}

std::vector<std::string> ErrorList::messages(const std::string& end) const {
  std::vector<Entry> sorted = errors_;
  const bool is_other_version = unusable_.contains(kVersionKey);
  if (is_other_version) std::erase_if(sorted, [](const Entry& entry) { return entry.key != kVersionKey; });
  std::ranges::stable_sort(sorted, {}, [](const Entry& entry) {
    return std::tuple(entry.location.override_index, entry.location.line, entry.location.column);
  });
  std::vector<std::string> messages;
  for (const Entry& entry : sorted) messages.push_back(entry.message + end);
  if (further_ > 0 && !is_other_version)
    messages.push_back(fmt::format("{}: and {} more", document_.file_name, further_));
  return messages;
}

void ErrorList::throw_if_any(const std::string& end) const {
  if (!is_empty()) throw_input_errors(messages(end));
}

}  // namespace seaglint

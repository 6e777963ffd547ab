// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/override.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/words.h"
#include "sim/scenario/files/scenario_document.h"

namespace seaglint {

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

}  // namespace seaglint

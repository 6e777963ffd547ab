// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/draws/variation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "sim/core/process/error.h"
#include "sim/core/text/words.h"
#include "sim/scenario/files/error_list.h"
#include "sim/scenario/files/scatter_diagram.h"
#include "sim/scenario/files/scenario_document.h"

namespace seaglint {

namespace {

// FNV-1a, 64 bits, of the path and the eight bytes of the number (Fowler, Noll and Vo 1991).
std::uint64_t hash_of(std::string_view path, std::uint64_t number) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&](std::uint64_t byte) { hash = (hash ^ byte) * 0x100000001b3; };
  for (const char c : path) add(static_cast<unsigned char>(c));
  for (int i = 0; i < 8; ++i) add(number >> (8 * i) & 0xff);
  return hash;
}

constexpr const char* kOtherKey = "must name another key that is written here, drawn as often if it is drawn";

constexpr std::array<const char*, 3> kPerSea{"sea", "sea_reflection", "targets"};
constexpr std::array<const char*, 3> kOfRadar{"radar.hop_code", "radar.pri_jitter_us", "radar.polarisation"};

std::optional<DrawnPer> drawn_per(const std::string& path) {
  const std::string section = path.substr(0, path.find('.'));
  const auto contains = [](const auto& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const bool is_class = path.ends_with(".label") || path.ends_with(".role");  // of the target, in all maps
  if (contains(kPerSea, section) && !is_class && path != kScatterKey) return DrawnPer::kSea;
  if (section == "view" || contains(kOfRadar, path)) return DrawnPer::kObservation;
  if (section == "clutter") return DrawnPer::kMap;
  return std::nullopt;
}

// Nothing for a node that is not a text, or none of a distribution.
std::optional<Distribution> distribution_of(const ScenarioDocument& document, const YamlNode& node,
                                            const std::string& path) {
  if (node.kind != YamlNode::Kind::kScalar) return std::nullopt;
  try {
    return parse_distribution(node.text);
  } catch (const InputError& error) {
    document.fail(node.location, path, fmt::format("value '{}': {}", node.text, error.what()));
  }
}

// KEY of a value same(KEY).
std::optional<std::string> same_key(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::kScalar || !node.text.starts_with("same(") || !node.text.ends_with(")"))
    return std::nullopt;
  return std::string(trimmed(std::string_view(node.text).substr(5, node.text.size() - 6)));
}

// What a search for drawn keys finds.
struct Search {
  const ScenarioDocument& document;
  ErrorList& errors;
  std::vector<Variation> found{};
};

void find(Search& search, const YamlNode& node, const std::string& path);

// The variation of an entry of a map, if it is one.
void find_entry(Search& search, const YamlEntry& entry, const std::string& at) {
  const ScenarioDocument& document = search.document;
  const YamlNode& value = entry.value;
  find(search, value, at);
  search.errors.attempt({at}, [&] {
    const std::optional<std::string> same = same_key(value);
    std::optional<Distribution> distribution = distribution_of(document, value, at);
    if (!distribution && !same) return;
    if (same == at) document.fail(value.location, at, fmt::format("value '{}': {}", value.text, kOtherKey));
    const std::optional<DrawnPer> per = drawn_per(at);
    if (!per) {
      document.fail(value.location, at,
                    fmt::format("value '{}': must be one value for all maps; values are drawn in view, sea, "
                                "sea_reflection, clutter, targets (without label and role), and as {}",
                                value.text, fmt::join(kOfRadar, ", ")));
    }
    search.found.push_back({at, distribution.value_or(Distribution{}), *per, same.value_or(at)});
  });
}

void find(Search& search, const YamlNode& node, const std::string& path) {
  const ScenarioDocument& document = search.document;
  const auto below = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const YamlNode& item = node.items[i];
    const std::string at = below(std::to_string(i));
    find(search, item, at);
    search.errors.attempt({at}, [&] {
      if (distribution_of(document, item, at))
        document.fail(item.location, at, fmt::format("value '{}': a distribution cannot be one of a list", item.text));
    });
  }
  for (const YamlEntry& entry : node.entries) find_entry(search, entry, below(entry.key));
}

// The scalar at a path through maps; null where there is none.
const YamlNode* scalar_at(const YamlNode& root, const std::string& path) {
  const YamlNode* node = &root;
  for (const std::string& key : split_path(path)) {
    if (node != nullptr) node = node->find(key);
  }
  return node != nullptr && node->kind == YamlNode::Kind::kScalar ? node : nullptr;
}

// The scalar at a path through maps and lists.
YamlNode& node_at(YamlNode& root, const std::string& path) {
  YamlNode* node = &root;
  for (const std::string& key : split_path(path))
    node = node->kind == YamlNode::Kind::kList ? &node->items[std::stoul(key)] : node->find(key);
  return *node;
}

// Adds a key of the section of `path`, with the place of `path` in messages.
void add_beside(YamlNode& root, const std::string& path, const std::string& key_path, const std::string& value) {
  const std::size_t dot = path.rfind('.');
  const Location location = node_at(root, path).location;
  YamlNode node;
  node.kind = YamlNode::Kind::kScalar;
  node.location = location;
  node.text = value;
  node_at(root, path.substr(0, dot)).entries.push_back({key_path.substr(key_path.rfind('.') + 1), location, node});
}

}  // namespace

const char* name(DrawnPer per) {
  return per == DrawnPer::kSea ? "sea" : per == DrawnPer::kObservation ? "observation" : "map";
}

std::string Variation::text() const {
  return drawn_as == key_path || !is_written() ? distribution.text() : fmt::format("same({})", drawn_as);
}

void copy_fixed_values(ScenarioDocument& document) {
  ErrorList errors(document);  // find_variations() finds them too
  Search search{document, errors};
  find(search, document.root, "");
  const std::vector<Variation>& found = search.found;
  for (const Variation& variation : found) {
    if (errors.is_unusable(variation.drawn_as)) continue;
    const bool is_drawn = std::ranges::find(found, variation.drawn_as, &Variation::key_path) != found.end();
    const YamlNode* fixed = is_drawn ? nullptr : scalar_at(document.root, variation.drawn_as);
    if (fixed == nullptr) continue;
    YamlNode& node = node_at(document.root, variation.key_path);
    node.text = fixed->text;
    node.quoted = fixed->quoted;
  }
}

std::vector<Variation> find_variations(const ScenarioDocument& document, ErrorList& errors) {
  Search search{document, errors};
  find(search, document.root, "");
  const std::vector<Variation>& found = search.found;
  std::vector<Variation> variations;
  for (Variation variation : found) {
    if (variation.drawn_as != variation.key_path) {
      const auto other = std::ranges::find(found, variation.drawn_as, &Variation::key_path);
      const bool is_drawn = other != found.end() && other->drawn_as == other->key_path && other->per == variation.per;
      if (!is_drawn && errors.is_unusable(variation.drawn_as)) {
        errors.exclude(variation.key_path);
      } else if (!is_drawn) {
        errors.attempt({variation.key_path}, [&] { document.fail_at(variation.key_path, kOtherKey); });
      }
      if (!is_drawn) continue;
      variation.distribution = other->distribution;
    }
    variations.push_back(std::move(variation));
  }
  std::ranges::sort(variations, {}, &Variation::key_path);
  return variations;
}

std::vector<Variation> scatter_variations(const std::shared_ptr<const ScatterDiagram>& diagram) {
  std::vector<Variation> variations;
  for (const bool is_period : {false, true}) {
    Variation variation;
    variation.key_path = "sea." + (is_period ? diagram->period_key : "significant_wave_height_m");
    variation.distribution.kind = DistributionKind::kScatter;
    variation.distribution.diagram = diagram;
    variation.distribution.is_period = is_period;
    variation.drawn_as = kScatterKey;
    variations.push_back(std::move(variation));
  }
  return variations;
}

std::string drawn_value(const Variation& variation, std::uint64_t seed, const DrawPlace& place) {
  const std::uint64_t number = variation.per == DrawnPer::kSea           ? place.sea
                               : variation.per == DrawnPer::kObservation ? place.observation
                                                                         : place.map;
  Random random({seed, Stream::kDraw, hash_of(variation.drawn_as, number)});
  return variation.distribution.draw(random);
}

ScenarioDocument with_values(const ScenarioDocument& document, const std::vector<Variation>& variations,
                             const std::vector<std::string>& values) {
  ScenarioDocument copy = document;
  for (std::size_t i = 0; i < variations.size(); ++i) {
    if (!variations[i].is_written()) {
      add_beside(copy.root, kScatterKey, variations[i].key_path, values[i]);
      continue;
    }
    copy.drawn_keys.push_back(variations[i].key_path);
    YamlNode& node = node_at(copy.root, variations[i].key_path);
    node.text = values[i];
    node.quoted = false;
  }
  return copy;
}

}  // namespace seaglint

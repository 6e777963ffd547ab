// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/draws/variation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

constexpr std::size_t kMaxChoices = 1000, kMaxWordBytes = 64;
constexpr double kMaxWhole = 2147483647;  // integers fit into int
constexpr double kNormalDeviations = 9;   // beyond those of any draw
constexpr double kLeastFraction = 0.01;   // of a normal distribution between its limits

constexpr std::array<const char*, 5> kNames{"uniform", "loguniform", "normal", "integers", "choice"};
constexpr std::array<const char*, 5> kForms{
    "uniform(a, b) with a < b", "loguniform(a, b) with 0 < a < b",
    "normal(mean, std) or normal(mean, std, low, high) with std > 0, low < high and at least 1 % of it between them",
    "integers(a, b) with whole numbers a < b", "choice(x, y, ...) of 2 to 1000 different values of at most 64 bytes"};

std::vector<std::string> separated(std::string_view text) {
  std::vector<std::string> values;
  std::string value;
  for (const char c : text) {
    if (c != ',' && c != ' ') {
      value += c;
    } else if (!value.empty()) {
      values.push_back(std::move(value));
      value.clear();
    }
  }
  if (!value.empty()) values.push_back(std::move(value));
  return values;
}

bool is_whole(double x) { return x == std::round(x) && std::abs(x) <= kMaxWhole; }

// Fraction of the normal distribution below x, |error| < 1e-15.
double normal_fraction(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

bool is_valid(const Distribution& d) {
  const std::vector<double>& n = d.numbers;
  switch (d.kind) {
    case DistributionKind::kUniform: return n.size() == 2 && n[0] < n[1];
    case DistributionKind::kLogUniform: return n.size() == 2 && 0 < n[0] && n[0] < n[1];
    case DistributionKind::kIntegers: return n.size() == 2 && n[0] < n[1] && is_whole(n[0]) && is_whole(n[1]);
    case DistributionKind::kNormal:
      if (n.size() == 2) return n[1] > 0;
      return n.size() == 4 && n[1] > 0 && n[2] < n[3] &&
             normal_fraction((n[3] - n[0]) / n[1]) - normal_fraction((n[2] - n[0]) / n[1]) >= kLeastFraction;
    case DistributionKind::kChoice:
      return d.values.size() >= 2 && d.values.size() <= kMaxChoices &&
             std::set<std::string>(d.values.begin(), d.values.end()).size() == d.values.size() &&
             std::all_of(d.values.begin(), d.values.end(),
                         [](const std::string& value) { return value.size() <= kMaxWordBytes; });
    case DistributionKind::kScatter: break;
  }
  return false;
}

// Of the uniform number u within 0 and 1, in the logarithm; by functions with the same bits on every machine.
double between_logarithmically(double low, double high, double u) {
  return std::clamp(low * reproducible_exp(u * reproducible_log(high / low)), low, high);
}

double of_pair(const SeaPair& pair, bool is_period) {
  return is_period ? pair.period_s : pair.significant_wave_height_m;
}

}  // namespace

std::string text_of(const ScalarValue& value) {
  return std::visit([](const auto& of) { return fmt::format("{}", of); }, value);
}

std::string Distribution::text() const {
  if (kind == DistributionKind::kScatter) return kScatterKey;
  return fmt::format("{}({})", kNames[static_cast<std::size_t>(kind)], fmt::join(values, ", "));
}

bool Distribution::is_numeric() const {
  return std::all_of(values.begin(), values.end(), [](const std::string& value) { return parse_number(value); });
}

ScalarValue Distribution::draw(Random& random) const {
  switch (kind) {
    case DistributionKind::kUniform: return numbers[0] + (numbers[1] - numbers[0]) * random.uniform();
    case DistributionKind::kLogUniform: return between_logarithmically(numbers[0], numbers[1], random.uniform());
    case DistributionKind::kIntegers: {
      const auto count = static_cast<std::uint32_t>(numbers[1] - numbers[0]) + 1;
      return numbers[0] + random.below(count);
    }
    case DistributionKind::kNormal: {
      double value = 0;
      do {
        value = numbers[0] + numbers[1] * random.normal();
      } while (numbers.size() == 4 && (value < numbers[2] || value > numbers[3]));
      return value;
    }
    case DistributionKind::kScatter: return of_pair(diagram->draw(random), is_period);
    case DistributionKind::kChoice: break;
  }
  return values[random.below(static_cast<std::uint32_t>(values.size()))];
}

std::string Distribution::middle() const {
  switch (kind) {
    case DistributionKind::kUniform: return fmt::format("{}", 0.5 * numbers[0] + 0.5 * numbers[1]);
    case DistributionKind::kLogUniform: return fmt::format("{}", between_logarithmically(numbers[0], numbers[1], 0.5));
    case DistributionKind::kIntegers: return fmt::format("{}", std::floor(0.5 * (numbers[0] + numbers[1])));
    case DistributionKind::kNormal:
      return fmt::format("{}", numbers.size() == 4 ? std::clamp(numbers[0], numbers[2], numbers[3]) : numbers[0]);
    case DistributionKind::kScatter: return fmt::format("{}", of_pair(diagram->likeliest(), is_period));
    case DistributionKind::kChoice: break;
  }
  return values.front();
}

std::vector<std::string> Distribution::ends() const {
  if (kind == DistributionKind::kChoice) return values;
  if (kind == DistributionKind::kScatter) {
    double lowest = std::numeric_limits<double>::infinity(), highest = 0;
    for (const ScatterCell& cell : diagram->cells) {
      lowest = std::min(lowest, is_period ? cell.lowest_period_s : cell.lowest_height_m);
      highest = std::max(highest, is_period ? cell.highest_period_s : cell.highest_height_m);
    }
    return {fmt::format("{}", lowest), fmt::format("{}", highest)};
  }
  if (kind != DistributionKind::kNormal) return {values[0], values[1]};
  if (numbers.size() == 4) return {values[2], values[3]};
  return {fmt::format("{}", numbers[0] - kNormalDeviations * numbers[1]),
          fmt::format("{}", numbers[0] + kNormalDeviations * numbers[1])};
}

std::optional<Distribution> parse_distribution(std::string_view text) {
  const std::size_t open = text.find('(');
  if (open == std::string_view::npos) return std::nullopt;
  const auto name = std::find(kNames.begin(), kNames.end(), text.substr(0, open));
  if (name == kNames.end()) return std::nullopt;
  const auto kind = static_cast<std::size_t>(name - kNames.begin());
  if (text.back() != ')') {
    throw InputError(fmt::format("must be {}, in quotes or with blanks for commas within braces", kForms[kind]));
  }
  Distribution read;
  read.kind = static_cast<DistributionKind>(kind);
  read.values = separated(text.substr(open + 1, text.size() - open - 2));
  bool numbers = true;
  if (read.kind != DistributionKind::kChoice) {
    for (const std::string& value : read.values) {
      const std::optional<double> number = parse_number(value);
      numbers = numbers && number;
      read.numbers.push_back(number.value_or(0));
    }
  }
  if (!numbers || !is_valid(read)) throw InputError(fmt::format("must be {}", kForms[kind]));
  return read;
}

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

constexpr std::array<std::string_view, 3> kPerSea{"sea", "sea_reflection", "targets"};
constexpr std::array<std::string_view, 4> kOfRadar{"radar.hop_code", "radar.pri_jitter_us", "radar.polarisation",
                                                   "looks.spacing_s"};

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

std::optional<DrawnPer> drawn_per(std::string_view path) {
  const std::string_view section = path.substr(0, path.find('.'));
  const auto is_one_of = [](const auto& names, std::string_view name) {
    return std::ranges::find(names, name) != std::end(names);
  };
  const bool is_class = path.ends_with(".label") || path.ends_with(".role");  // of the target, in all maps
  if (is_one_of(kPerSea, section) && !is_class && path != kScatterKey) return DrawnPer::kSea;
  if (section == "view" || is_one_of(kOfRadar, path)) return DrawnPer::kObservation;
  if (section == "clutter") return DrawnPer::kMap;
  return std::nullopt;
}

const char* name(DrawnPer per) {
  return per == DrawnPer::kSea ? "sea" : per == DrawnPer::kObservation ? "observation" : "map";
}

std::string Variation::text() const {
  return drawn_as == key_path || !is_written() ? distribution.text() : fmt::format("same({})", drawn_as);
}

std::vector<Variation> find_variations(ScenarioDocument& document, ErrorList& errors) {
  Search search{document, errors};
  find(search, document.root, "");
  const std::vector<Variation>& found = search.found;
  std::vector<Variation> variations;
  for (Variation variation : found) {
    const std::string &key = variation.key_path, &drawn_as = variation.drawn_as;
    if (drawn_as != key) {
      const auto other = std::ranges::find(found, drawn_as, &Variation::key_path);
      const YamlNode* fixed = other == found.end() ? scalar_at(document.root, drawn_as) : nullptr;
      const bool is_drawn = other != found.end() && other->drawn_as == other->key_path && other->per == variation.per;
      if (!is_drawn && errors.is_unusable(drawn_as)) {
        errors.exclude(key);
      } else if (fixed != nullptr) {
        YamlNode& node = node_at(document.root, key);
        node.text = fixed->text;
        node.quoted = fixed->quoted;
      } else if (!is_drawn) {
        errors.attempt({key}, [&] { document.fail_at(key, kOtherKey); });
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

ScalarValue drawn_value(const Variation& variation, std::uint64_t seed, const DrawPlace& place) {
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
    YamlNode& node = node_at(copy.root, variations[i].key_path);
    node.text = values[i];
    node.quoted = false;
  }
  return copy;
}

}  // namespace seaglint

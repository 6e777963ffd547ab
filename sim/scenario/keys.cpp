// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/names.h"
#include "sim/core/text/words.h"
#include "sim/scenario/fields.h"

namespace seaglint {

namespace {

std::string with_unit(std::string text, std::string_view unit) {
  return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

// What a field allows.
struct AllowedText {
  std::string_view unit;

  std::string number(const Bound& bound) const {
    return with_unit((bound.or_zero ? "0 or " : "") + bound.text(), unit);
  }
  std::string operator()(const NumberField& field) const { return number(field.bound); }
  std::string operator()(const NumberOrAutoField& field) const { return "auto, or " + number(field.bound); }
  std::string operator()(const IntegerField& field) const {
    const bool single = field.bound.lowest == field.bound.highest;
    return single ? fmt::format("{}", field.bound.lowest) : "whole, " + number(field.bound);
  }
  std::string operator()(const NaturalField&) const { return "whole, 0 <= x < 2^63"; }
  std::string operator()(const FlagField&) const { return "true, false"; }
  std::string operator()(const TextField&) const { return "text"; }
  std::string operator()(const ChoiceField& field) const { return fmt::format("{}", fmt::join(field.words, ", ")); }
  std::string operator()(const TripleField& field) const { return "[x, y, z], " + number(field.bound); }
  std::string operator()(const RatioField&) const { return "a:b, both greater than 0"; }
  std::string operator()(const SweepField& field) const {
    const std::string other = field.words.empty() ? "" : fmt::format(", or {}", fmt::join(field.words, " or "));
    return fmt::format("number, list or from:to:step, {}{}", number(field.bound), other);
  }
  std::string operator()(const HoldOutsField&) const { return "{COLUMN: value, LOW:HIGH or a list of these}"; }
  std::string operator()(const NamesField& field) const {
    return fmt::format("list of {} to {} different names", field.least, field.most);
  }
};

class Lister : public PathVisitor {
 public:
  std::vector<KeyEntry> rows;

  void value(const char* key, const KeyField& value, const char* meaning) override {
    const std::string path = path_of(key);
    const std::string_view unit = unit_of(path);
    const bool is_absent =
        is_optional_ && (std::holds_alternative<NumberField>(value) || std::holds_alternative<TripleField>(value));
    const std::string standard = path == required_ ? "required" : is_absent ? "" : value_as_yaml(value);
    rows.push_back({path, standard == "\"\"" || standard == "[]" ? "" : standard, std::visit(AllowedText{unit}, value),
                    std::string(unit), meaning, drawn_per(path)});
    // A list has no distributions.
    if (std::holds_alternative<TripleField>(value)) rows.back().drawn = std::nullopt;
    is_optional_ = false;
  }
  void section(const char* key, const Fields& fields, const char*) override {
    is_optional_ = false;
    below(key, fields);
  }
  void items(const char* key, const FieldItems& items, const char*) override {
    const std::string name = items.is_list ? "N" : "NAME";
    items.resize({name});
    below(std::string(key) + "." + name, [&](FieldVisitor& v) { items.item(0, v); });
    if (items.is_list) items.resize({});
  }
  void require(const char* key, bool, const char*) override { required_ = path_of(key); }
  bool optional(const char*, bool present) override {
    is_optional_ = !present;
    return true;
  }

 private:
  std::string required_;      // path of the last required key
  bool is_optional_ = false;  // the next field has no default
};

// The key with names of targets and indices as NAME and N: targets.ship.points.0 -> targets.NAME.points.N.
std::string general_key(std::string_view key) {
  std::vector<std::string> words = split_path(std::string(key));
  for (std::string& word : words) {
    if (!word.empty() && word.find_first_not_of("0123456789") == std::string::npos) word = "N";
  }
  if (words.size() > 1 && words[0] == "targets") words[1] = "NAME";
  return fmt::format("{}", fmt::join(words, "."));
}

// The rows of a key, of a section, or with a text in key or meaning, the first of these that has any.
std::vector<KeyEntry> rows_of(std::string_view of) {
  const std::vector<KeyEntry> all = scenario_keys();
  const std::string asked = general_key(of), word = lower_case(of);
  std::vector<KeyEntry> rows;
  const auto is_below = [&](const KeyEntry& row) { return row.key == asked || row.key.starts_with(asked + "."); };
  std::ranges::copy_if(all, std::back_inserter(rows), is_below);
  if (!rows.empty()) return rows;
  const auto has_word = [&](const KeyEntry& row) {
    return lower_case(row.key).find(word) != std::string::npos ||
           lower_case(row.meaning).find(word) != std::string::npos;
  };
  std::ranges::copy_if(all, std::back_inserter(rows), has_word);
  if (!rows.empty()) return rows;
  std::vector<std::string> known;
  for (const KeyEntry& row : all) known.push_back(row.key);
  throw InputError(fmt::format("{}: unknown key or section, and in no key's meaning: {}", of,
                               near_suggestion(asked, known).value_or("`seaglint keys` lists all")));
}

}  // namespace

std::vector<KeyEntry> scenario_keys() {
  Scenario scenario;
  Lister lister;
  visit_fields(scenario, lister);
  return std::move(lister.rows);
}

std::string allowed_text(const KeyField& value, std::string_view unit) { return std::visit(AllowedText{unit}, value); }

std::string list_keys(std::string_view of) {
  const std::vector<KeyEntry> rows = of.empty() ? scenario_keys() : rows_of(of);
  std::size_t path_width = 0, standard_width = 0;
  for (const KeyEntry& row : rows) {
    path_width = std::max(path_width, row.key.size());
    standard_width = std::max(standard_width, row.standard.size());
  }
  std::string text;
  for (const KeyEntry& row : rows) {
    text += fmt::format("{:{}}  {:{}}  {}\n", row.key, path_width, row.standard, standard_width, row.allowed);
    if (of.empty()) continue;
    text += fmt::format("    {}\n", row.meaning);
    if (row.drawn) text += fmt::format("    May be drawn, once per {}.\n", name(*row.drawn));
  }
  return text;
}

std::string keys_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const KeyEntry& entry : scenario_keys()) {
    list.push_back({{"key", entry.key},
                    {"default", entry.standard},
                    {"allowed", entry.allowed},
                    {"unit", entry.unit},
                    {"meaning", entry.meaning},
                    {"drawn_per", entry.drawn ? name(*entry.drawn) : ""}});
  }
  return list.dump(1) + "\n";
}

namespace {

using Schema = nlohmann::ordered_json;

// Whole numbers without a decimal point.
Schema json_number(double x) {
  return x == std::round(x) && std::abs(x) < 1e15 ? Schema(static_cast<std::int64_t>(x)) : Schema(x);
}

Schema number_schema(const Bound& bound, const char* type = "number") {
  Schema schema{{"type", type}};
  if (std::isfinite(bound.lowest))
    schema[bound.without_lowest ? "exclusiveMinimum" : "minimum"] = json_number(bound.lowest);
  if (std::isfinite(bound.highest))
    schema[bound.without_highest ? "exclusiveMaximum" : "maximum"] = json_number(bound.highest);
  return schema;
}

// The forms that a field allows, one of which a value must have.
struct FormSchemas {
  static std::vector<Schema> number(const Bound& bound) {
    std::vector<Schema> forms{number_schema(bound)};
    if (bound.or_zero) forms.push_back({{"const", 0}});
    return forms;
  }
  static Schema one_of(const FieldWords& words) {
    Schema schema{{"enum", Schema::array()}};
    for (const char* word : words) schema["enum"].push_back(word);
    return schema;
  }
  static Schema text() { return {{"type", {"string", "number", "boolean"}}}; }
  static Schema list(const Schema& item, std::size_t least, std::size_t most) {
    return {{"type", "array"}, {"items", item}, {"minItems", least}, {"maxItems", most}};
  }

  std::vector<Schema> operator()(const NumberField& field) const { return number(field.bound); }
  std::vector<Schema> operator()(const NumberOrAutoField& field) const {
    std::vector<Schema> forms = number(field.bound);
    forms.push_back({{"const", "auto"}});
    return forms;
  }
  std::vector<Schema> operator()(const IntegerField& field) const { return {number_schema(field.bound, "integer")}; }
  std::vector<Schema> operator()(const NaturalField&) const { return {{{"type", "integer"}, {"minimum", 0}}}; }
  std::vector<Schema> operator()(const FlagField&) const { return {{{"type", "boolean"}}}; }
  std::vector<Schema> operator()(const TextField&) const { return {text()}; }
  std::vector<Schema> operator()(const ChoiceField& field) const { return {one_of(field.words)}; }
  std::vector<Schema> operator()(const TripleField& field) const { return {list(number_schema(field.bound), 3, 3)}; }
  std::vector<Schema> operator()(const RatioField&) const {
    return {{{"type", "string"}, {"pattern", "^[^:]+:[^:]+$"}}};
  }
  std::vector<Schema> operator()(const SweepField& field) const {
    std::vector<Schema> forms = number(field.bound);
    const Schema item = forms.size() == 1 ? forms[0] : Schema{{"anyOf", forms}};
    forms.push_back(list(item, 1, 10000));
    forms.push_back({{"type", "string"}, {"pattern", "^[^:]+:[^:]+:[^:]+$"}, {"description", "from:to:step"}});
    if (!field.words.empty()) forms.push_back(one_of(field.words));
    return forms;
  }
  std::vector<Schema> operator()(const HoldOutsField&) const {
    const Schema value{{"anyOf", {text(), list(text(), 1, 1000)}}};
    return {{{"type", "object"}, {"maxProperties", 100}, {"additionalProperties", value}}};
  }
  std::vector<Schema> operator()(const NamesField& field) const { return {list(text(), field.least, field.most)}; }
};

class SchemaWriter : public PathVisitor {
 public:
  SchemaWriter() {
    for (const KeyEntry& entry : scenario_keys()) entries_.emplace(entry.key, entry);
  }

  // Of a map with these fields.
  Schema map_of(const Fields& fields, const char* meaning) {
    const Schema outer = std::exchange(map_, Schema{{"type", "object"}});
    if (*meaning != '\0') map_["description"] = meaning;
    map_["additionalProperties"] = false;
    map_["properties"] = Schema::object();
    fields(*this);
    return std::exchange(map_, outer);
  }

  void value(const char* key, const KeyField& value, const char* meaning) override {
    const std::string path = path_of(key);
    const KeyEntry& entry = entries_.at(path);
    std::vector<Schema> forms = std::visit(FormSchemas(), value);
    std::string description = fmt::format("{} [{}]", meaning, entry.allowed);
    if (!entry.standard.empty() && entry.standard != "required")
      description += fmt::format(" Default: {}.", entry.standard);
    if (entry.drawn) {
      forms.push_back({{"$ref", "#/definitions/drawn"}});
      description += fmt::format(" May be drawn, once per {}.", name(*entry.drawn));
    }
    Schema schema{{"description", description}};
    if (forms.size() == 1) {
      schema.update(forms[0]);
    } else {
      schema["anyOf"] = forms;
    }
    map_["properties"][key] = schema;
  }
  void section(const char* key, const Fields& fields, const char* meaning) override {
    below(key, [&](FieldVisitor&) { map_["properties"][key] = map_of(fields, meaning); });
  }
  void items(const char* key, const FieldItems& items, const char* meaning) override {
    const std::string item_name = items.is_list ? "N" : "NAME";
    items.resize({item_name});
    Schema item;
    below(std::string(key) + "." + item_name,
          [&](FieldVisitor&) { item = map_of([&](FieldVisitor& v) { items.item(0, v); }, ""); });
    if (items.is_list) items.resize({});
    Schema& schema = map_["properties"][key] = {{"description", meaning}};
    if (items.is_list) {
      schema.update(FormSchemas::list(item, 1, items.most));
    } else {
      schema.update({{"type", "object"},
                     {"propertyNames", {{"pattern", "^[A-Za-z0-9_-]{1,64}$"}}},
                     {"additionalProperties", item},
                     {"minProperties", items.when_empty == nullptr ? 1 : 0},
                     {"maxProperties", items.most}});
    }
  }
  void require(const char* key, bool always, const char*) override {
    if (always) map_["required"].push_back(key);
  }
  bool optional(const char*, bool) override { return true; }

 private:
  std::map<std::string, KeyEntry> entries_;  // by their keys
  Schema map_;
};

}  // namespace

std::string scenario_schema() {
  Scenario scenario;
  SchemaWriter writer;
  Schema schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "seaglint scenario"}};
  schema.update(writer.map_of([&](FieldVisitor& v) { visit_fields(scenario, v); }, "A scenario of seaglint."));
  schema["definitions"]["drawn"] = {
      {"type", "string"},
      {"pattern", "^(uniform|loguniform|normal|integers|choice|same)\\(.+\\)$"},
      {"description",
       "A distribution: uniform(a, b), loguniform(a, b), normal(mean, std), normal(mean, std, low, high), "
       "integers(a, b), choice(x, y, ...); same(KEY): the value of another key."}};
  return schema.dump(1) + "\n";
}

namespace {

constexpr std::size_t kMaxListed = 8;  // values of a sweep
constexpr std::size_t kMaxWords = 8;   // that are compared

// At most `count` of the values, equally spaced, first and last among them.
std::vector<std::string> spaced(const std::vector<std::string>& values, std::size_t count) {
  if (values.size() <= count) return values;
  std::vector<std::string> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(values[i * (values.size() - 1) / (count - 1)]);
  return some;
}

// Collects the sweeps with several values.
struct SweepCollector : PathVisitor {
  std::vector<VariedKey> found;

  void value(const char* key, const KeyField& value, const char*) override {
    const auto* sweep = std::get_if<SweepField>(&value);
    if (sweep != nullptr && sweep->values.size() > 1) found.push_back({path_of(key), sweep->values, nullptr});
  }
};

}  // namespace

std::string VariedKey::text() const {
  if (drawn != nullptr) return fmt::format("{}, once per {}", shown(drawn->text()), name(drawn->per));
  if (sweep.size() <= kMaxListed) return fmt::format("{}", fmt::join(sweep, ", "));
  const auto [low, high] = std::ranges::minmax(sweep);
  return fmt::format("{} to {} in {} values", low, high, sweep.size());
}

std::vector<std::string> VariedKey::trial_values() const {
  std::vector<std::string> values;
  if (drawn != nullptr) {
    values = {drawn->distribution.middle()};
    for (std::string& end : spaced(drawn->distribution.ends(), kMaxWords)) values.push_back(std::move(end));
  } else {
    for (const double value : {sweep[sweep.size() / 2], sweep.front(), sweep.back()})
      values.push_back(fmt::format("{}", value));
  }
  std::set<std::string> known;
  std::erase_if(values, [&](const std::string& value) { return !known.insert(value).second; });
  return values;
}

std::vector<VariedKey> varied_keys(const Scenario& scenario) {
  Scenario copy = scenario;
  SweepCollector sweeps;
  visit_fields(copy, sweeps);
  std::vector<VariedKey> keys = std::move(sweeps.found);
  for (const Variation& variation : scenario.variations) keys.push_back({variation.key_path, {}, &variation});
  return keys;
}

}  // namespace seaglint

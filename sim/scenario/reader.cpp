// SPDX-License-Identifier: BSD-3-Clause
// Reads values into the members of the table of fields: of a document, and those that are drawn.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/names.h"
#include "sim/core/text/words.h"
#include "sim/scenario/fields.h"

namespace seaglint {

namespace {

constexpr std::size_t kMaxSweepValues = 10000;

// A value as shown in error messages: "value 'x'", "a list".
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

// A scalar without quotes.
bool is_plain(const YamlNode& node) { return node.kind == YamlNode::Kind::kScalar && !node.quoted; }

// The whole number of a plain scalar; nothing for any other node.
std::optional<std::int64_t> integer_of(const YamlNode& node) {
  return is_plain(node) ? parse_integer(node.text) : std::nullopt;
}

// Letters, digits, '_' and '-' of ASCII.
bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

// An entry and a later one with the same key.
struct Duplicate {
  const YamlEntry* first;
  const YamlEntry* second;
};

std::vector<Duplicate> duplicates(const YamlNode& map) {
  std::vector<const YamlEntry*> sorted;
  for (const YamlEntry& entry : map.entries) sorted.push_back(&entry);
  std::ranges::stable_sort(sorted, {}, &YamlEntry::key);
  std::vector<Duplicate> found;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i - 1]->key == sorted[i]->key) found.push_back({sorted[i - 1], sorted[i]});
  }
  return found;
}

// Throws the InputError of a value: "value 'x': must be ...".
[[noreturn]] void refuse(const ScenarioDocument& document, const YamlNode& node, const std::string& path,
                         const std::string& bound) {
  const std::string note = node.kind == YamlNode::Kind::kScalar ? lookalike_note(node.text) : "";
  document.fail(node.location, path, fmt::format("{}: {}{}", value_text(node), bound, note));
}

[[noreturn]] void refuse_duplicate(const ScenarioDocument& document, const Duplicate& keys, const std::string& path) {
  document.fail(keys.second->location, path.empty() ? keys.second->key : path + "." + keys.second->key,
                fmt::format("this key appears twice, first in line {}", keys.first->location.line));
}

void check_duplicates(const ScenarioDocument& document, const YamlNode& map, const std::string& path) {
  const std::vector<Duplicate> found = duplicates(map);
  if (!found.empty()) refuse_duplicate(document, found.front(), path);
}

// Reads the value of one field, at the place `path` of a document. Throws InputError for a wrong one, before the member
// is set.
class ValueReader {
 public:
  ValueReader(const ScenarioDocument& document, const YamlNode& node, std::string path)
      : document_(document), node_(node), path_(std::move(path)) {}

  void operator()(const NumberField& field) const { field.value = number_of(node_, path_, field.bound, "a number"); }

  void operator()(const NumberOrAutoField& field) const {
    const bool is_auto = node_.kind == YamlNode::Kind::kScalar && node_.text == "auto";
    field.value = is_auto ? std::nullopt : std::optional(number_of(node_, path_, field.bound, "auto or a number"));
  }

  void operator()(const IntegerField& field) const {
    const std::optional<std::int64_t> read = integer_of(node_);
    if (!read || !field.bound.holds(static_cast<double>(*read))) {
      const bool single = field.bound.lowest == field.bound.highest;
      fail(single ? fmt::format("must be {}", field.bound.lowest) : "must be a whole number " + field.bound.text());
    }
    field.value = static_cast<int>(*read);
  }

  void operator()(const NaturalField& field) const {
    const std::optional<std::int64_t> read = integer_of(node_);
    if (!read || *read < 0) fail("must be a whole number within 0 and 9223372036854775807");
    field.value = static_cast<std::uint64_t>(*read);
  }

  void operator()(const FlagField& field) const {
    // The three spellings of the YAML 1.2 core schema.
    const auto is_one_of = [&](std::initializer_list<const char*> words) {
      return is_plain(node_) && std::find(words.begin(), words.end(), node_.text) != words.end();
    };
    const bool is_true = is_one_of({"true", "True", "TRUE"});
    if (!is_true && !is_one_of({"false", "False", "FALSE"})) fail("must be true or false");
    field.value = is_true;
  }

  void operator()(const TextField& field) const { field.value = text_of(node_, path_); }

  void operator()(const ChoiceField& field) const {
    const auto found = std::ranges::find(field.words, std::string_view(node_.text));
    const bool many = field.words.size() > 2;
    if (node_.kind != YamlNode::Kind::kScalar || found == field.words.end())
      fail(fmt::format("must be {}{}", many ? "one of " : "", fmt::join(field.words, many ? ", " : " or ")));
    field.index = static_cast<std::size_t>(found - field.words.begin());
  }

  void operator()(const TripleField& field) const {
    if (node_.kind != YamlNode::Kind::kList || node_.items.size() != 3)
      fail("must be a list of three numbers [x, y, z]");
    std::array<double, 3> read{};
    for (std::size_t i = 0; i < 3; ++i)
      read[i] = number_of(node_.items[i], fmt::format("{}.{}", path_, i), field.bound, "a number");
    field.values = read;
  }

  void operator()(const RatioField& field) const {
    const std::size_t colon = node_.text.find(':');
    if (node_.kind == YamlNode::Kind::kScalar && colon != std::string::npos) {
      const std::optional<double> a = parse_number(std::string_view(node_.text).substr(0, colon));
      const std::optional<double> b = parse_number(std::string_view(node_.text).substr(colon + 1));
      const double read = a && b && *a > 0 && *b > 0 ? *a / (*a + *b) : 0;
      if (read > 0 && read < 1) {
        field.fraction = read;
        return;
      }
    }
    fail("must be a ratio a:b of two positive numbers");
  }

  void operator()(const SweepField& field) const {
    const auto found = std::ranges::find(field.words, std::string_view(node_.text));
    if (node_.kind == YamlNode::Kind::kScalar && found != field.words.end()) {
      field.word = static_cast<std::size_t>(found - field.words.begin()) + 1;
      field.values.clear();
      return;
    }
    Sweep read = node_.kind == YamlNode::Kind::kList ? list_sweep(field.bound) : scalar_sweep(field);
    Sweep sorted = read;
    std::ranges::sort(sorted);
    const auto twice = std::ranges::adjacent_find(sorted);
    if (twice != sorted.end()) document_.fail(node_.location, path_, fmt::format("value '{}' appears twice", *twice));
    field.word = 0;
    field.values = std::move(read);
  }

  void operator()(const HoldOutsField& field) const {
    constexpr std::size_t kMaxColumns = 100, kMaxValues = 1000;
    if (node_.kind != YamlNode::Kind::kMap || node_.entries.size() > kMaxColumns)
      fail(fmt::format("must be a map of at most {} columns with their values", kMaxColumns));
    check_duplicates(document_, node_, path_);
    std::vector<HoldOutSpec> columns;
    for (const YamlEntry& entry : node_.entries) {
      const std::string path = path_ + "." + entry.key;
      const bool is_list = entry.value.kind == YamlNode::Kind::kList;
      const std::span<const YamlNode> values = is_list ? std::span(entry.value.items) : std::span(&entry.value, 1);
      if (values.empty() || values.size() > kMaxValues)
        refuse(document_, entry.value, path, fmt::format("must be a value or a list of 1 to {} values", kMaxValues));
      columns.push_back({entry.key, {}});
      for (const YamlNode& value : values) columns.back().values.push_back(text_of(value, path));
    }
    field.columns = std::move(columns);
  }

  void operator()(const NamesField& field) const {
    if (node_.kind != YamlNode::Kind::kList || node_.items.size() < field.least || node_.items.size() > field.most)
      fail(fmt::format("must be a list of {} to {} names", field.least, field.most));
    constexpr std::size_t kLongest = 40;
    std::vector<std::string> names;
    std::set<std::string> different;  // with '_' for a space, as in names of columns
    for (const YamlNode& item : node_.items) {
      const std::string path = fmt::format("{}.{}", path_, names.size()), &name = item.text;
      const auto is_allowed = [](char c) { return c == ' ' || is_name_character(c); };
      if (item.kind != YamlNode::Kind::kScalar || name.empty() || name.size() > kLongest || name.front() == ' ' ||
          name.back() == ' ' || !std::ranges::all_of(name, is_allowed))
        refuse(document_, item, path,
               fmt::format("must be 1 to {} letters, digits, '_', '-' or spaces within", kLongest));
      std::string word = name;
      std::ranges::replace(word, ' ', '_');
      if (!different.insert(word).second)
        refuse(document_, item, path, "must differ from the others, also with '_' for a space");
      names.push_back(name);
    }
    field.values = std::move(names);
  }

 private:
  [[noreturn]] void fail(const std::string& bound) const { refuse(document_, node_, path_, bound); }

  std::string text_of(const YamlNode& node, const std::string& path) const {
    constexpr std::size_t kLongest = 4096;
    const bool printable = std::none_of(node.text.begin(), node.text.end(),
                                        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
    if (node.kind != YamlNode::Kind::kScalar || node.text.empty() || node.text.size() > kLongest || !printable)
      refuse(document_, node, path, fmt::format("must be a text of 1 to {} printable characters", kLongest));
    return node.text;
  }

  double number_of(const YamlNode& node, const std::string& path, const Bound& bound, const std::string& what) const {
    const std::optional<double> value = is_plain(node) ? parse_number(node.text) : std::nullopt;
    if (!value || !bound.holds(*value))
      refuse(document_, node, path, fmt::format("must be {}{} {}", bound.or_zero ? "0 or " : "", what, bound.text()));
    return *value;
  }

  Sweep list_sweep(const Bound& bound) const {
    if (node_.items.empty() || node_.items.size() > kMaxSweepValues)
      fail(fmt::format("must be a list of 1 to {} numbers", kMaxSweepValues));
    Sweep values;
    for (const YamlNode& item : node_.items) values.push_back(number_of(item, path_, bound, "a list of numbers"));
    return values;
  }

  Sweep scalar_sweep(const SweepField& field) const {
    const Bound& bound = field.bound;
    const std::string other = field.words.empty() ? "" : fmt::format(", or {}", fmt::join(field.words, " or "));
    const std::string what = fmt::format("must be a number, a list or from:to:step, {}{}{}",
                                         bound.or_zero ? "0 or " : "", bound.text(), other);
    // A range may be quoted, as other YAML readers require.
    const bool has_colon = node_.text.find(':') != std::string::npos;
    if (!is_plain(node_) && !(node_.quoted && has_colon)) fail(what);
    if (!has_colon && !parse_number(node_.text)) fail(what);
    Sweep values;
    try {
      values = parse_range(node_.text, kMaxSweepValues);
    } catch (const InputError& error) {
      document_.fail(node_.location, path_, error.what());
    }
    if (!std::ranges::all_of(values, [&](double value) { return bound.holds(value); })) fail(what);
    return values;
  }

  const ScenarioDocument& document_;
  const YamlNode& node_;
  std::string path_;
};

// The keys a map may have.
struct KeyCollector : FieldVisitor {
  std::vector<std::string> keys;

  void value(const char* key, const KeyField&, const char*) override { keys.emplace_back(key); }
  void section(const char* key, const Fields&, const char*) override { keys.emplace_back(key); }
  void items(const char* key, const FieldItems&, const char*) override { keys.emplace_back(key); }
  bool optional(const char* key, bool) override {
    keys.emplace_back(key);
    return false;
  }
};

// Reads the fields of one map. Fields without a key in the map, and those with an error, keep their defaults.
class Reader : public FieldVisitor {
 public:
  Reader(const ScenarioDocument& document, ErrorList& errors, const YamlNode& map, std::string path)
      : document_(document), errors_(errors), map_(map), path_(std::move(path)) {}

  // Visits the fields twice: for the keys they allow, then for the values.
  void read(const Fields& fields) {
    check_keys(fields);
    fields(*this);
  }

  void value(const char* key, const KeyField& value, const char*) override {
    const bool is_read =
        attempt(key, [&](const YamlNode& node) { std::visit(ValueReader(document_, node, path_of(key)), value); });
    if (!is_read && std::holds_alternative<ChoiceField>(value)) needs_are_known_ = false;
  }

  void section(const char* key, const Fields& fields, const char*) override {
    if (const YamlNode* node = map_.find(key)) read_map(*node, path_of(key), fields);
  }

  void items(const char* key, const FieldItems& items, const char*) override {
    const YamlNode* node = map_.find(key);
    if (node == nullptr) return;
    const std::string path = path_of(key);
    std::vector<const YamlNode*> maps;
    std::vector<std::string> names;
    if (items.is_list && errors_.is_unusable(path)) return;
    const bool is_read = errors_.attempt({path}, [&] {
      const bool is_right = node->kind == (items.is_list ? YamlNode::Kind::kList : YamlNode::Kind::kMap);
      const std::size_t size = items.is_list ? node->items.size() : node->entries.size();
      const bool is_empty_allowed = items.when_empty != nullptr;
      if (!is_right || (size == 0 && !is_empty_allowed) || size > items.most)
        refuse(document_, *node, path,
               fmt::format("must be a {} 1 to {} {}{}", items.is_list ? "list of" : "map of", items.most,
                           items.is_list ? "maps" : "named maps",
                           is_empty_allowed ? fmt::format(", or {{}}: {}", items.when_empty) : ""));
      check_duplicates(document_, *node, path);
    });
    if (!is_read) return;
    for (const YamlNode& item : node->items) {
      names.push_back(std::to_string(maps.size()));
      maps.push_back(&item);
    }
    for (const YamlEntry& entry : node->entries) {
      if (!errors_.attempt({path}, [&] { check_name(entry, path); })) continue;
      names.push_back(entry.key);
      maps.push_back(&entry.value);
    }
    items.resize(names);
    for (std::size_t i = 0; i < names.size(); ++i)
      read_map(*maps[i], path + "." + names[i], [&](FieldVisitor& visitor) { items.item(i, visitor); });
  }

  void require(const char* key, bool, const char* note) override {
    if (map_.find(key) != nullptr || !needs_are_known_) return;
    errors_.attempt({path_of(key)},
                    [&] { document_.fail(map_.location, path_of(key), fmt::format("this key is missing{}", note)); });
  }

  bool optional(const char* key, bool) override { return map_.find(key) != nullptr; }

 private:
  // Calls read(node) for the value of a key, and records its error. False for a value with an error, now or recorded
  // before.
  template <typename Read>
  bool attempt(const char* key, const Read& read) {
    const YamlNode* node = map_.find(key);
    if (node == nullptr) return true;
    const std::string path = path_of(key);
    return !errors_.is_unusable(path) && errors_.attempt({path}, [&] { read(*node); });
  }

  void read_map(const YamlNode& node, const std::string& path, const Fields& fields) {
    const bool is_map = errors_.attempt({path}, [&] {
      if (node.kind != YamlNode::Kind::kMap) refuse(document_, node, path, "must be a map of key: value");
    });
    if (is_map) Reader(document_, errors_, node, path).read(fields);
  }

  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  void check_keys(const Fields& fields) {
    for (const Duplicate& keys : duplicates(map_)) {
      const std::string path = path_of(keys.second->key);
      if (errors_.is_full()) {
        errors_.count_further({path});
      } else {
        errors_.attempt({path}, [&] { refuse_duplicate(document_, keys, path_); });
      }
    }
    KeyCollector allowed;
    fields(allowed);
    bool is_cut = false;  // the value before is cut at a comma, as uniform(5, 9) in braces is
    for (const YamlEntry& entry : map_.entries) {
      if (is_cut && entry.value.kind == YamlNode::Kind::kNull) continue;
      const bool is_known = std::ranges::find(allowed.keys, entry.key) != allowed.keys.end();
      is_cut = is_known && entry.value.text.find('(') != std::string::npos && errors_.is_unusable(path_of(entry.key));
      if (is_known) continue;
      if (errors_.is_full()) {
        errors_.count_further({path_});
        needs_are_known_ = false;
        continue;
      }
      errors_.attempt({path_}, [&] { refuse_key(entry, allowed.keys); });
    }
  }

  // It may be one that the map needs.
  [[noreturn]] void refuse_key(const YamlEntry& entry, const std::vector<std::string>& allowed) {
    needs_are_known_ = false;
    const std::string path = path_of(entry.key);
    const std::string lookalike = lookalike_in(entry.key);
    document_.fail(
        entry.location, path,
        "unknown key: " + (lookalike.empty() ? suggestion(entry.key, allowed)
                                             : fmt::format("it has {}; keys are indented by blanks", lookalike)));
  }

  // Names become parts of file names and of key paths.
  void check_name(const YamlEntry& entry, const std::string& path) const {
    constexpr std::size_t kLongest = 64;
    if (entry.key.empty() || entry.key.size() > kLongest ||
        !std::all_of(entry.key.begin(), entry.key.end(), is_name_character)) {
      document_.fail(entry.location, path,
                     fmt::format("name '{}': must be 1 to {} letters, digits, '_' or '-'",
                                 entry.key.substr(0, kLongest), kLongest));
    }
  }

  const ScenarioDocument& document_;
  ErrorList& errors_;
  const YamlNode& map_;
  std::string path_;
  bool needs_are_known_ = true;  // false where an error leaves open which keys the map needs
};

// Sets the members of keys by their paths.
class Assigner : public PathVisitor {
 public:
  Assigner(const std::vector<KeyValue>& values, const ScenarioDocument& document, ErrorList& errors)
      : document_(document), errors_(errors) {
    for (const KeyValue& value : values) values_.emplace(value.key_path, &value.value);
  }

  void value(const char* key, const KeyField& field, const char*) override {
    const std::string path = path_of(key);
    const auto found = values_.find(path);
    if (found == values_.end()) return;
    const double* number = std::get_if<double>(found->second);
    if (number != nullptr && std::visit([&](const auto& of) { return set(of, *number); }, field)) return;
    YamlNode node;
    node.kind = YamlNode::Kind::kScalar;
    node.location = document_.location_of(path);
    node.text = text_of(*found->second);
    errors_.attempt({path}, [&] { std::visit(ValueReader(document_, node, path), field); });
  }

  bool optional(const char* key, bool present) override {
    const std::string path = path_of(key);
    const auto next = values_.lower_bound(path);
    return present || (next != values_.end() && (next->first == path || next->first.starts_with(path + ".")));
  }

 private:
  // False for a field that is no number.
  template <typename Field>
  static bool set(const Field& field, double number) {
    if constexpr (std::is_same_v<Field, SweepField>) {
      field.values = {number};
      field.word = 0;
      return true;
    } else if constexpr (std::is_same_v<Field, NumberField> || std::is_same_v<Field, NumberOrAutoField> ||
                         std::is_same_v<Field, IntegerField> || std::is_same_v<Field, NaturalField>) {
      field.value = static_cast<std::remove_reference_t<decltype(field.value)>>(number);
      return true;
    } else {
      return false;
    }
  }

  const ScenarioDocument& document_;
  ErrorList& errors_;
  std::map<std::string, const ScalarValue*> values_;
};

}  // namespace

void read_fields(const ScenarioDocument& document, ErrorList& errors, const Fields& fields) {
  const YamlNode& root = document.root;
  const bool is_map = errors.attempt({""}, [&] {
    if (root.kind == YamlNode::Kind::kNull)
      throw InputError(fmt::format("{}: the file is empty: must be a map of key: value", document.file_name));
    if (root.kind != YamlNode::Kind::kMap) {
      throw InputError(fmt::format("{}:{}:{}: {}: must be a map of key: value", document.file_name, root.location.line,
                                   root.location.column, value_text(root)));
    }
  });
  if (is_map) Reader(document, errors, root, "").read(fields);
}

Scenario read_fields(const ScenarioDocument& document, ErrorList& errors) {
  Scenario scenario;
  read_fields(document, errors, [&](FieldVisitor& visitor) { visit_fields(scenario, visitor); });
  return scenario;
}

void assign(Scenario& scenario, const std::vector<KeyValue>& values, const ScenarioDocument& document,
            ErrorList& errors) {
  Assigner assigner(values, document, errors);
  visit_fields(scenario, assigner);
}

}  // namespace seaglint

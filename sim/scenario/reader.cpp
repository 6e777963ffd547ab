// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/names.h"
#include "sim/core/text/words.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/files/document.h"
#include "sim/scenario/files/error_list.h"

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

// The keys a map may have.
class KeyCollector : public FieldVisitor {
 public:
  std::vector<std::string> keys;

  void number(const char* key, double&, const Bound&) override { keys.emplace_back(key); }
  void number_or_auto(const char* key, std::optional<double>&, const Bound&) override { keys.emplace_back(key); }
  void integer(const char* key, int&, const Bound&) override { keys.emplace_back(key); }
  void natural(const char* key, std::uint64_t&) override { keys.emplace_back(key); }
  void flag(const char* key, bool&) override { keys.emplace_back(key); }
  void text(const char* key, std::string&) override { keys.emplace_back(key); }
  void choice(const char* key, std::size_t&, Names) override { keys.emplace_back(key); }
  void triple(const char* key, std::array<double, 3>&, const Bound&) override { keys.emplace_back(key); }
  void ratio(const char* key, double&) override { keys.emplace_back(key); }
  void sweep(const char* key, Sweep&, const Bound&, Names, std::size_t*) override { keys.emplace_back(key); }
  void hold_outs(const char* key, std::vector<HoldOutSpec>&) override { keys.emplace_back(key); }
  void section(const char* key, const Fields&) override { keys.emplace_back(key); }
  void list(const char* key, std::size_t, std::size_t, const std::function<void(std::size_t)>&,
            const std::function<void(std::size_t, FieldVisitor&)>&) override {
    keys.emplace_back(key);
  }
  void words(const char* key, std::vector<std::string>&, std::size_t, std::size_t) override { keys.emplace_back(key); }
  void dictionary(const char* key, const std::vector<std::string>&, std::size_t,
                  const std::function<void(const std::vector<std::string>&)>&,
                  const std::function<void(std::size_t, FieldVisitor&)>&) override {
    keys.emplace_back(key);
  }
  void require(const char*) override {}
  bool optional(const char* key, bool) override {
    keys.emplace_back(key);
    return false;
  }
};

// Where values are read from, and the errors of them.
struct Source {
  const ScenarioDocument& document;
  ErrorList& errors;
};

// Reads the fields of one map. Fields without a key in the map, and those with an error, keep their defaults.
class Reader : public FieldVisitor {
 public:
  // Visits the fields twice: for the keys they allow, then for the values.
  static void read(const Source& source, const YamlNode& map, const std::string& path, const Fields& fields) {
    Reader reader(source, map, path);
    reader.check_keys(fields);
    fields(reader);
  }

  void number(const char* key, double& value, const Bound& bound) override {
    read_value(key, [&](const YamlNode& node) { value = number_of(node, path_of(key), bound, "a number"); });
  }

  void number_or_auto(const char* key, std::optional<double>& value, const Bound& bound) override {
    read_value(key, [&](const YamlNode& node) {
      const bool is_auto = node.kind == YamlNode::Kind::kScalar && node.text == "auto";
      value = is_auto ? std::nullopt : std::optional(number_of(node, path_of(key), bound, "auto or a number"));
    });
  }

  void integer(const char* key, int& value, const Bound& bound) override {
    read_value(key, [&](const YamlNode& node) {
      const std::optional<std::int64_t> read = integer_of(node);
      if (!read || !bound.holds(static_cast<double>(*read))) {
        const bool single = bound.lowest == bound.highest;
        fail(node, path_of(key),
             single ? fmt::format("must be {}", bound.lowest) : "must be a whole number " + bound.text());
      }
      value = static_cast<int>(*read);
    });
  }

  void natural(const char* key, std::uint64_t& value) override {
    read_value(key, [&](const YamlNode& node) {
      const std::optional<std::int64_t> read = integer_of(node);
      if (!read || *read < 0) fail(node, path_of(key), "must be a whole number within 0 and 9223372036854775807");
      value = static_cast<std::uint64_t>(*read);
    });
  }

  void flag(const char* key, bool& value) override {
    read_value(key, [&](const YamlNode& node) {
      // The three spellings of the YAML 1.2 core schema.
      const auto is_one_of = [&](std::initializer_list<const char*> words) {
        return is_plain(node) && std::find(words.begin(), words.end(), node.text) != words.end();
      };
      value = is_one_of({"true", "True", "TRUE"});
      if (!value && !is_one_of({"false", "False", "FALSE"})) fail(node, path_of(key), "must be true or false");
    });
  }

  void text(const char* key, std::string& value) override {
    read_value(key, [&](const YamlNode& node) { value = text_of(node, path_of(key)); });
  }

  void choice(const char* key, std::size_t& index, Names names) override {
    const bool is_read = read_value(key, [&](const YamlNode& node) {
      const auto found = std::find(names.begin(), names.end(), std::string_view(node.text));
      if (node.kind != YamlNode::Kind::kScalar || found == names.end())
        fail(node, path_of(key),
             fmt::format("must be {}{}", names.size() > 2 ? "one of " : "",
                         fmt::join(names, names.size() > 2 ? ", " : " or ")));
      index = static_cast<std::size_t>(found - names.begin());
    });
    if (!is_read) needs_are_known_ = false;
  }

  void triple(const char* key, std::array<double, 3>& values, const Bound& bound) override {
    read_value(key, [&](const YamlNode& node) {
      if (node.kind != YamlNode::Kind::kList || node.items.size() != 3)
        fail(node, path_of(key), "must be a list of three numbers [x, y, z]");
      for (std::size_t i = 0; i < 3; ++i)
        values[i] = number_of(node.items[i], fmt::format("{}.{}", path_of(key), i), bound, "a number");
    });
  }

  void ratio(const char* key, double& fraction) override {
    read_value(key, [&](const YamlNode& node) {
      const std::size_t colon = node.text.find(':');
      if (node.kind == YamlNode::Kind::kScalar && colon != std::string::npos) {
        const std::optional<double> a = parse_number(std::string_view(node.text).substr(0, colon));
        const std::optional<double> b = parse_number(std::string_view(node.text).substr(colon + 1));
        if (a && b && *a > 0 && *b > 0) {
          const double read = *a / (*a + *b);
          if (read > 0 && read < 1) {
            fraction = read;
            return;
          }
        }
      }
      fail(node, path_of(key), "must be a ratio a:b of two positive numbers");
    });
  }

  void sweep(const char* key, Sweep& values, const Bound& bound, Names words, std::size_t* word) override {
    read_value(key, [&](const YamlNode& node) {
      const auto found = std::find(words.begin(), words.end(), std::string_view(node.text));
      if (node.kind == YamlNode::Kind::kScalar && found != words.end()) {
        *word = static_cast<std::size_t>(found - words.begin()) + 1;
        values.clear();
        return;
      }
      Sweep read = node.kind == YamlNode::Kind::kList ? list_sweep(node, path_of(key), bound)
                                                      : scalar_sweep(node, path_of(key), bound, words);
      Sweep sorted = read;
      std::sort(sorted.begin(), sorted.end());
      const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
      if (twice != sorted.end())
        document().fail(node.location, path_of(key), fmt::format("value '{}' appears twice", *twice));
      if (word != nullptr) *word = 0;
      values = std::move(read);
    });
  }

  void hold_outs(const char* key, std::vector<HoldOutSpec>& columns) override {
    read_value(key, [&](const YamlNode& node) {
      constexpr std::size_t kMaxColumns = 100, kMaxValues = 1000;
      if (node.kind != YamlNode::Kind::kMap || node.entries.size() > kMaxColumns)
        fail(node, path_of(key), fmt::format("must be a map of at most {} columns with their values", kMaxColumns));
      check_duplicates(node, path_of(key));
      columns.clear();
      for (const YamlEntry& entry : node.entries) {
        const std::string path = path_of(key) + "." + entry.key;
        const bool is_list = entry.value.kind == YamlNode::Kind::kList;
        const std::span<const YamlNode> values = is_list ? std::span(entry.value.items) : std::span(&entry.value, 1);
        if (values.empty() || values.size() > kMaxValues)
          fail(entry.value, path, fmt::format("must be a value or a list of 1 to {} values", kMaxValues));
        columns.push_back({entry.key, {}});
        for (const YamlNode& value : values) columns.back().values.push_back(text_of(value, path));
      }
    });
  }

  void section(const char* key, const Fields& fields) override {
    if (const YamlNode* node = map_.find(key)) read_map(*node, path_of(key), fields);
  }

  void list(const char* key, std::size_t, std::size_t max_size, const std::function<void(std::size_t)>& resize,
            const std::function<void(std::size_t, FieldVisitor&)>& item) override {
    const YamlNode* node = map_.find(key);
    if (node == nullptr) return;
    const bool is_list = read_value(key, [&](const YamlNode& value) {
      if (value.kind != YamlNode::Kind::kList || value.items.empty() || value.items.size() > max_size)
        fail(value, path_of(key), fmt::format("must be a list of 1 to {} maps", max_size));
    });
    if (!is_list) return;
    resize(node->items.size());
    for (std::size_t i = 0; i < node->items.size(); ++i)
      read_map(node->items[i], fmt::format("{}.{}", path_of(key), i), [&](FieldVisitor& visitor) { item(i, visitor); });
  }

  void words(const char* key, std::vector<std::string>& values, std::size_t least, std::size_t most) override {
    read_value(key, [&](const YamlNode& node) {
      if (node.kind != YamlNode::Kind::kList || node.items.size() < least || node.items.size() > most)
        fail(node, path_of(key), fmt::format("must be a list of {} to {} names", least, most));
      constexpr std::size_t kLongest = 40;
      values.clear();
      std::set<std::string> different;  // with '_' for a space, as in names of columns
      for (const YamlNode& item : node.items) {
        const std::string path = fmt::format("{}.{}", path_of(key), values.size()), &name = item.text;
        const auto is_allowed = [](char c) { return c == ' ' || is_name_character(c); };
        if (item.kind != YamlNode::Kind::kScalar || name.empty() || name.size() > kLongest || name.front() == ' ' ||
            name.back() == ' ' || !std::all_of(name.begin(), name.end(), is_allowed))
          fail(item, path, fmt::format("must be 1 to {} letters, digits, '_', '-' or spaces within", kLongest));
        std::string word = name;
        std::replace(word.begin(), word.end(), ' ', '_');
        if (!different.insert(word).second) fail(item, path, "must differ from the others, also with '_' for a space");
        values.push_back(name);
      }
    });
  }

  void dictionary(const char* key, const std::vector<std::string>&, std::size_t max_size,
                  const std::function<void(const std::vector<std::string>&)>& rename,
                  const std::function<void(std::size_t, FieldVisitor&)>& item) override {
    const YamlNode* node = map_.find(key);
    if (node == nullptr) return;
    std::vector<const YamlEntry*> entries;
    std::vector<std::string> names;
    const bool is_map = errors().attempt({path_of(key)}, [&] {
      if (node->kind != YamlNode::Kind::kMap || node->entries.empty() || node->entries.size() > max_size)
        fail(*node, path_of(key), fmt::format("must be a map of 1 to {} named maps", max_size));
      check_duplicates(*node, path_of(key));
    });
    if (!is_map) return;
    for (const YamlEntry& entry : node->entries) {
      if (!errors().attempt({path_of(key)}, [&] { check_name(entry, path_of(key)); })) continue;
      entries.push_back(&entry);
      names.push_back(entry.key);
    }
    rename(names);
    for (std::size_t i = 0; i < names.size(); ++i)
      read_map(entries[i]->value, path_of(key) + "." + names[i], [&](FieldVisitor& visitor) { item(i, visitor); });
  }

  void require(const char* key) override {
    if (map_.find(key) != nullptr || !needs_are_known_) return;
    errors().attempt({path_of(key)}, [&] { document().fail(map_.location, path_of(key), "this key is missing"); });
  }

  bool optional(const char* key, bool) override { return map_.find(key) != nullptr; }

 private:
  Reader(const Source& source, const YamlNode& map, std::string path)
      : source_(source), map_(map), path_(std::move(path)) {}

  const ScenarioDocument& document() const { return source_.document; }
  ErrorList& errors() const { return source_.errors; }

  // Calls read(node) for the value of a key, and records its error. False for a value with an error, now or recorded
  // before.
  template <typename Read>
  bool read_value(const char* key, const Read& read) {
    const YamlNode* node = map_.find(key);
    if (node == nullptr) return true;
    const std::string path = path_of(key);
    return !errors().is_unusable(path) && errors().attempt({path}, [&] { read(*node); });
  }

  void read_map(const YamlNode& node, const std::string& path, const Fields& fields) {
    if (errors().attempt({path}, [&] { expect_map(node, path); })) read(source_, node, path, fields);
  }

  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  [[noreturn]] void fail(const YamlNode& node, const std::string& path, const std::string& bound) const {
    const std::string note = node.kind == YamlNode::Kind::kScalar ? lookalike_note(node.text) : "";
    document().fail(node.location, path, fmt::format("{}: {}{}", value_text(node), bound, note));
  }

  void expect_map(const YamlNode& node, const std::string& path) const {
    if (node.kind != YamlNode::Kind::kMap) fail(node, path, "must be a map of key: value");
  }

  // An entry and a later one with the same key.
  struct Duplicate {
    const YamlEntry* first;
    const YamlEntry* second;
  };

  static std::vector<Duplicate> duplicates(const YamlNode& map) {
    std::vector<const YamlEntry*> sorted;
    for (const YamlEntry& entry : map.entries) sorted.push_back(&entry);
    std::ranges::stable_sort(sorted, {}, &YamlEntry::key);
    std::vector<Duplicate> found;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i - 1]->key == sorted[i]->key) found.push_back({sorted[i - 1], sorted[i]});
    }
    return found;
  }

  [[noreturn]] void refuse_duplicate(const Duplicate& keys, const std::string& path) const {
    document().fail(keys.second->location, path.empty() ? keys.second->key : path + "." + keys.second->key,
                    fmt::format("this key appears twice, first in line {}", keys.first->location.line));
  }

  void check_duplicates(const YamlNode& map, const std::string& path) const {
    const std::vector<Duplicate> found = duplicates(map);
    if (!found.empty()) refuse_duplicate(found.front(), path);
  }

  void check_keys(const Fields& fields) {
    for (const Duplicate& keys : duplicates(map_)) {
      const std::string path = path_of(keys.second->key);
      if (errors().is_full()) {
        errors().count_further({path});
      } else {
        errors().attempt({path}, [&] { refuse_duplicate(keys, path_); });
      }
    }
    KeyCollector allowed;
    fields(allowed);
    std::sort(allowed.keys.begin(), allowed.keys.end());
    bool is_cut = false;  // the value before is cut at a comma, as uniform(5, 9) in braces is
    for (const YamlEntry& entry : map_.entries) {
      if (is_cut && entry.value.kind == YamlNode::Kind::kNull) continue;
      const bool is_known = std::binary_search(allowed.keys.begin(), allowed.keys.end(), entry.key);
      is_cut = is_known && entry.value.text.find('(') != std::string::npos && errors().is_unusable(path_of(entry.key));
      if (is_known) continue;
      if (errors().is_full()) {
        errors().count_further({path_});
        needs_are_known_ = false;
        continue;
      }
      errors().attempt({path_}, [&] { refuse_key(entry, fields); });
    }
  }

  // It may be one that the map needs.
  [[noreturn]] void refuse_key(const YamlEntry& entry, const Fields& fields) {
    needs_are_known_ = false;
    const std::string path = path_of(entry.key);
    KeyCollector allowed;
    fields(allowed);
    const std::string lookalike = lookalike_in(entry.key);
    document().fail(
        entry.location, path,
        "unknown key: " + (lookalike.empty() ? suggestion(entry.key, allowed.keys)
                                             : fmt::format("it has {}; keys are indented by blanks", lookalike)));
  }

  // Names become parts of file names and of key paths.
  void check_name(const YamlEntry& entry, const std::string& path) const {
    constexpr std::size_t kLongest = 64;
    if (entry.key.empty() || entry.key.size() > kLongest ||
        !std::all_of(entry.key.begin(), entry.key.end(), is_name_character)) {
      document().fail(entry.location, path,
                      fmt::format("name '{}': must be 1 to {} letters, digits, '_' or '-'",
                                  entry.key.substr(0, kLongest), kLongest));
    }
  }

  std::string text_of(const YamlNode& node, const std::string& path) const {
    constexpr std::size_t kLongest = 4096;
    const bool printable = std::none_of(node.text.begin(), node.text.end(),
                                        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
    if (node.kind != YamlNode::Kind::kScalar || node.text.empty() || node.text.size() > kLongest || !printable)
      fail(node, path, fmt::format("must be a text of 1 to {} printable characters", kLongest));
    return node.text;
  }

  double number_of(const YamlNode& node, const std::string& path, const Bound& bound, const std::string& what) const {
    const std::optional<double> value = is_plain(node) ? parse_number(node.text) : std::nullopt;
    if (!value || !bound.holds(*value))
      fail(node, path, fmt::format("must be {}{} {}", bound.or_zero ? "0 or " : "", what, bound.text()));
    return *value;
  }

  Sweep list_sweep(const YamlNode& list, const std::string& path, const Bound& bound) const {
    if (list.items.empty() || list.items.size() > kMaxSweepValues) {
      fail(list, path, fmt::format("must be a list of 1 to {} numbers", kMaxSweepValues));
    }
    Sweep values;
    for (const YamlNode& item : list.items) values.push_back(number_of(item, path, bound, "a list of numbers"));
    return values;
  }

  Sweep scalar_sweep(const YamlNode& node, const std::string& path, const Bound& bound, Names words) const {
    const std::string other = words.empty() ? "" : fmt::format(", or {}", fmt::join(words, " or "));
    const std::string what = fmt::format("must be a number, a list or from:to:step, {}{}{}",
                                         bound.or_zero ? "0 or " : "", bound.text(), other);
    // A range may be quoted, as other YAML readers require.
    const bool readable = is_plain(node) || (node.quoted && node.text.find(':') != std::string::npos);
    if (!readable) fail(node, path, what);
    if (node.text.find(':') == std::string::npos && !parse_number(node.text)) fail(node, path, what);
    Sweep values;
    try {
      values = parse_range(node.text, kMaxSweepValues);
    } catch (const InputError& error) {
      document().fail(node.location, path, error.what());
    }
    if (!std::all_of(values.begin(), values.end(), [&](double value) { return bound.holds(value); }))
      fail(node, path, what);
    return values;
  }

  Source source_;
  const YamlNode& map_;
  std::string path_;
  bool needs_are_known_ = true;  // false where an error leaves open which keys the map needs
};

}  // namespace

void read_fields(const ScenarioDocument& document, ErrorList& errors,
                 const std::function<void(FieldVisitor&)>& fields) {
  const YamlNode& root = document.root;
  const bool is_map = errors.attempt({""}, [&] {
    if (root.kind == YamlNode::Kind::kNull)
      throw InputError(fmt::format("{}: the file is empty: must be a map of key: value", document.file_name));
    if (root.kind != YamlNode::Kind::kMap) {
      throw InputError(fmt::format("{}:{}:{}: {}: must be a map of key: value", document.file_name, root.location.line,
                                   root.location.column, value_text(root)));
    }
  });
  if (is_map) Reader::read({document, errors}, root, "", fields);
}

Scenario read_fields(const ScenarioDocument& document, ErrorList& errors) {
  Scenario scenario;
  read_fields(document, errors, [&](FieldVisitor& visitor) { visit_fields(scenario, visitor); });
  return scenario;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The table of a scenario's keys: each key is stated once (fields.cpp), with the member that has its value and default,
// its bound and its meaning. Reading, writing, the list of keys, the JSON Schema and drawn values are visitors of this
// table. The unit of a number is the ending of its key (unit_of()).

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

struct Bound {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool without_lowest = false;   // lowest excluded
  bool without_highest = false;  // highest excluded
  bool or_zero = false;          // zero also allowed

  bool holds(double value) const;
  std::string text() const;  // "within 0.1 and 300", "greater than 0", ...; without or_zero
};

constexpr Bound within(double lowest, double highest) { return {lowest, highest}; }
constexpr Bound zero_or_within(double lowest, double highest) {
  return {.lowest = lowest, .highest = highest, .or_zero = true};
}
constexpr Bound above(double lowest) { return {.lowest = lowest, .without_lowest = true}; }
constexpr Bound above_up_to(double lowest, double highest) {
  return {.lowest = lowest, .highest = highest, .without_lowest = true};
}

// The unit that the ending of a key states: "GHz" of carrier_ghz, "m/s" of speed_mps; empty: none.
std::string_view unit_of(std::string_view key);

// The forms of a value, each with the member that has it.
using FieldWords = std::span<const char* const>;
struct NumberField {
  double& value;
  Bound bound;
};
struct NumberOrAutoField {  // the word auto: none
  std::optional<double>& value;
  Bound bound;
};
struct IntegerField {
  int& value;
  Bound bound;
};
struct NaturalField {  // 0 <= x < 2^63: data sets store signed numbers
  std::uint64_t& value;
};
struct FlagField {
  bool& value;
};
struct TextField {
  std::string& value;
};
struct ChoiceField {  // words[index]
  std::size_t& index;
  FieldWords words;
};
struct TripleField {
  std::array<double, 3>& values;
  Bound bound;
};
struct RatioField {  // written a:b for the fraction a/(a+b)
  double& fraction;
};
// A number, a list or from:to:step, or one of `words`: word is 0 for numbers, else the number of the word from 1, with
// values empty.
struct SweepField {
  Sweep& values;
  Bound bound;
  FieldWords words;
  std::size_t& word;
};
struct HoldOutsField {  // a map of columns, each with a value or a list of values
  std::vector<HoldOutSpec>& columns;
};
struct NamesField {  // a list of least..most different names: letters, digits, '_', '-', spaces within
  std::vector<std::string>& values;
  std::size_t least, most;
};
using KeyField = std::variant<NumberField, NumberOrAutoField, IntegerField, NaturalField, FlagField, TextField,
                              ChoiceField, TripleField, RatioField, SweepField, HoldOutsField, NamesField>;

class FieldVisitor;
using Fields = std::function<void(FieldVisitor&)>;

// A list of maps, or a map of named maps.
struct FieldItems {
  bool is_list = false;
  std::vector<std::string> names = {};                               // keys of the items; of a list "0", "1", ...
  std::size_t most = 0;                                              // 1 to `most` items
  const char* when_empty = nullptr;                                  // what no item means; null: not allowed
  std::function<void(const std::vector<std::string>&)> resize = {};  // makes the items of these names
  std::function<void(std::size_t, FieldVisitor&)> item = {};         // visits the fields of an item
};

// Operation on each field. Keys are string literals, meanings whole sentences.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;

  virtual void value(const char* key, const KeyField& value, const char* meaning) = 0;
  virtual void section(const char* key, const Fields& fields, const char* meaning) = 0;
  virtual void items(const char* key, const FieldItems& items, const char* meaning) = 0;
  // The key must be in the file; always: whatever the other keys are; note: ends the message of its absence.
  virtual void require(const char*, bool /*always*/ = true, const char* /*note*/ = "") {}
  // Returns whether to visit an optional field. present: whether it has a value; when reading, the result is whether
  // the file has the key.
  virtual bool optional(const char*, bool present) { return present; }

  void number(const char* key, double& x, const Bound& bound, const char* meaning) {
    value(key, NumberField{x, bound}, meaning);
  }
  void integer(const char* key, int& x, const Bound& bound, const char* meaning) {
    value(key, IntegerField{x, bound}, meaning);
  }
  void flag(const char* key, bool& x, const char* meaning) { value(key, FlagField{x}, meaning); }
  void text(const char* key, std::string& x, const char* meaning) { value(key, TextField{x}, meaning); }
  void triple(const char* key, std::array<double, 3>& x, const Bound& bound, const char* meaning) {
    value(key, TripleField{x, bound}, meaning);
  }
  // An enumeration whose values are 0, 1, ... in the order of the words.
  template <typename Enumeration, std::size_t n>
  void choice(const char* key, Enumeration& x, const char* const (&words)[n], const char* meaning) {
    auto index = static_cast<std::size_t>(x);
    value(key, ChoiceField{index, words}, meaning);
    x = static_cast<Enumeration>(index);
  }
  // The fields of a spec, and a list of specs as maps.
  template <typename Spec>
  using Visit = std::type_identity_t<void (*)(Spec&, FieldVisitor&)>;
  template <typename Spec>
  void section(const char* key, Spec& spec, Visit<Spec> visit, const char* meaning) {
    section(
        key, [&](FieldVisitor& v) { visit(spec, v); }, meaning);
  }
  template <typename Spec>
  void list(const char* key, std::vector<Spec>& specs, std::size_t most, Visit<Spec> visit, const char* meaning) {
    if (!optional(key, !specs.empty())) return;
    FieldItems maps{.is_list = true, .most = most};
    for (std::size_t i = 0; i < specs.size(); ++i) maps.names.push_back(std::to_string(i));
    maps.resize = [&](const std::vector<std::string>& names) { specs.resize(names.size()); };
    maps.item = [&](std::size_t i, FieldVisitor& v) { visit(specs[i], v); };
    items(key, maps, meaning);
  }
};

// A visitor that knows the path of what it visits, "targets.ship.motion.model".
class PathVisitor : public FieldVisitor {
 public:
  void section(const char* key, const Fields& fields, const char*) override { below(key, fields); }
  void items(const char* key, const FieldItems& items, const char*) override {
    for (std::size_t i = 0; i < items.names.size(); ++i)
      below(std::string(key) + "." + items.names[i], [&](FieldVisitor& v) { items.item(i, v); });
  }

 protected:
  std::string path_of(std::string_view key) const { return prefix_ + std::string(key); }
  void below(const std::string& key, const Fields& fields) {
    const std::string before = std::exchange(prefix_, prefix_ + key + ".");
    fields(*this);
    prefix_ = before;
  }

 private:
  std::string prefix_;
};

// A value as YAML, and what its field allows: "within 0.1 and 300 GHz".
std::string value_as_yaml(const KeyField& value);
std::string allowed_text(const KeyField& value, std::string_view unit);

// All fields of a scenario, section by section, in output order.
void visit_fields(Scenario& scenario, FieldVisitor& visitor);

// Reads every field of a document. Records an error for each unknown or duplicate key, missing required one, wrong type
// and value out of its bounds; such a field has its default.
Scenario read_fields(const ScenarioDocument& document, ErrorList& errors);
// The same for another table.
void read_fields(const ScenarioDocument& document, ErrorList& errors, const Fields& fields);

// Sets the members of these keys; a word is read as in the document, and its error recorded. A key may be one that the
// scenario has by another value only.
void assign(Scenario& scenario, const std::vector<KeyValue>& values, const ScenarioDocument& document,
            ErrorList& errors);

// Records an error for each inconsistency between keys without errors, at the key that most likely causes it.
void check_contradictions(const Scenario& scenario, const ScenarioDocument& document, ErrorList& errors);

// Throws InputError for a part that is not among `companions`, the companions that the scenario's targets have with any
// of its drawn values: it would be in no map.
void check_parts(const Scenario& scenario, const std::set<std::string>& companions, const ScenarioDocument& document);

}  // namespace seaglint

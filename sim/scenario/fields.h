// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// All fields of a scenario with their keys and bounds, listed once; reading, checking and writing are visitors of this
// list.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/scenario/files/bound.h"
#include "sim/scenario/scenario_spec.h"

namespace seaglint {

// Operation on each field. Keys are string literals.
class FieldVisitor {
 public:
  using Fields = std::function<void(FieldVisitor&)>;
  using Names = std::span<const char* const>;

  virtual ~FieldVisitor() = default;

  virtual void number(const char* key, double& value, const Bound& bound) = 0;
  // A number, or the word auto for none.
  virtual void number_or_auto(const char* key, std::optional<double>& value, const Bound& bound) = 0;
  virtual void integer(const char* key, int& value, const Bound& bound) = 0;
  // 0 <= x < 2^63: data sets store signed numbers
  virtual void natural(const char* key, std::uint64_t& value) = 0;
  virtual void flag(const char* key, bool& value) = 0;
  virtual void text(const char* key, std::string& value) = 0;
  virtual void choice(const char* key, std::size_t& index, Names names) = 0;  // names[index]
  virtual void triple(const char* key, std::array<double, 3>& values, const Bound& bound) = 0;
  virtual void ratio(const char* key, double& fraction) = 0;  // written a:b for the fraction a/(a+b)
  // A number, a list or from:to:step, or one of `words`: *word is 0 for numbers, else the 1-based index of the word,
  // with values empty.
  virtual void sweep(const char* key, Sweep& values, const Bound& bound, Names words = {},
                     std::size_t* word = nullptr) = 0;
  // A map of columns, each with a value or a list of values.
  virtual void hold_outs(const char* key, std::vector<HoldOutSpec>& columns) = 0;
  virtual void section(const char* key, const Fields& fields) = 0;
  // A list of maps: resize(n) is called when reading, then item(i, visitor) for each.
  virtual void list(const char* key, std::size_t size, std::size_t max_size,
                    const std::function<void(std::size_t)>& resize,
                    const std::function<void(std::size_t, FieldVisitor&)>& item) = 0;
  // A list of least..most different words: letters, digits, '_', '-', spaces within.
  virtual void words(const char* key, std::vector<std::string>& values, std::size_t least, std::size_t most) = 0;
  // A map of maps: rename(names) is called when reading, then item(i, visitor) for each.
  virtual void dictionary(const char* key, const std::vector<std::string>& names, std::size_t max_size,
                          const std::function<void(const std::vector<std::string>&)>& rename,
                          const std::function<void(std::size_t, FieldVisitor&)>& item) = 0;

  // The key must be in the file.
  virtual void require(const char* key) = 0;
  // Returns whether to visit an optional field. present: whether it has a value; when reading, the result is whether
  // the file has the key.
  virtual bool optional(const char* key, bool present) = 0;
};

// An enumeration whose values are 0, 1, ... in the order of the names.
template <typename Enumeration, std::size_t n>
void visit_choice(FieldVisitor& v, const char* key, Enumeration& value, const char* const (&names)[n]) {
  auto index = static_cast<std::size_t>(value);
  v.choice(key, index, names);
  value = static_cast<Enumeration>(index);
}

// All fields of a scenario, section by section, in output order.
void visit_fields(Scenario& scenario, FieldVisitor& visitor);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Bounds of a number.

#include <limits>
#include <string>

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

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Distributions from which the values of a scenario's keys are drawn, written in the place of a value.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/numbers/random.h"

namespace seaglint {

struct ScatterDiagram;

// Key of the diagram of kScatter.
inline constexpr const char* kScatterKey = "sea.scatter_diagram";

enum class DistributionKind { kUniform, kLogUniform, kNormal, kIntegers, kChoice, kScatter };

// uniform(a, b)                   a < b
// loguniform(a, b)                0 < a < b; uniform in the logarithm
// normal(mean, std)               std > 0
// normal(mean, std, low, high)    the same between low < high, which contain at least 1 % of it
// integers(a, b)                  whole numbers a < b, both included, each equally often
// choice(x, y, ...)               2 to 1000 different words or numbers of at most 64 bytes, each equally often
// kScatter is one of the two values of a scatter diagram, which no key has written: the wave height, or the period that
// is drawn with it from the same random numbers.
struct Distribution {
  DistributionKind kind = DistributionKind::kUniform;
  std::vector<std::string> values;                          // in the parentheses, as written
  std::vector<double> numbers;                              // the same, but for kChoice
  std::shared_ptr<const ScatterDiagram> diagram = nullptr;  // of kScatter
  bool is_period = false;                                   // of kScatter

  // As written in a scenario, with commas: "uniform(5, 9)"; "sea.scatter_diagram" for kScatter.
  std::string text() const;

  // True if all values are numbers.
  bool is_numeric() const;

  // A value with the fewest digits that read back to the same bits.
  std::string draw(Random& random) const;

  // Middle of the distribution (its median; of whole numbers the lower one, of words the first; of a diagram the centre
  // of its likeliest cell).
  std::string middle() const;

  // Values within which all draws are: both ends, of words all. A normal distribution without limits ends at 9 standard
  // deviations: Random::normal() stays within 8.3.
  std::vector<std::string> ends() const;
};

// The distribution that a value names; values in the parentheses are separated by commas or blanks. Nothing for a text
// that is none. Throws InputError without a place, "must be ...", for wrong numbers in the parentheses.
std::optional<Distribution> parse_distribution(std::string_view text);

}  // namespace seaglint

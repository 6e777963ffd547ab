// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Keys of a scenario whose values are drawn: distributions, written in the place of a value, and the values that are
// drawn from them.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/files/tables.h"

namespace seaglint {

// Key of the diagram of kScatter.
inline constexpr const char* kScatterKey = "sea.scatter_diagram";

// The value of a key: a number, or a word as it is written.
using ScalarValue = std::variant<double, std::string>;
std::string text_of(const ScalarValue& value);  // a number with the fewest digits that read back to the same bits

struct KeyValue {
  std::string key_path;
  ScalarValue value;
};

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
  std::vector<std::string> values;            // in the parentheses, as written
  std::vector<double> numbers;                // the same, but for kChoice
  FileContents<ScatterDiagram> diagram = {};  // of kScatter
  bool is_period = false;                     // of kScatter

  // As written in a scenario, with commas: "uniform(5, 9)"; "sea.scatter_diagram" for kScatter.
  std::string text() const;

  // True if all values are numbers.
  bool is_numeric() const;

  // A number, or a word of kChoice.
  ScalarValue draw(Random& random) const;

  // Middle of the distribution (its median; of whole numbers the lower one, of words the first; of a diagram the centre
  // of its likeliest cell).
  std::string middle() const;

  // Values within which all draws are: both ends, of words all. A normal distribution without limits ends at 9 standard
  // deviations: Random::normal() stays within 8.3.
  std::vector<std::string> ends() const;

  bool operator==(const Distribution&) const = default;
};

// The distribution that a value names; values in the parentheses are separated by commas or blanks. Nothing for a text
// that is none. Throws InputError without a place, "must be ...", for wrong numbers in the parentheses.
std::optional<Distribution> parse_distribution(std::string_view text);

// How often a value is drawn: keys of `sea`, `sea_reflection` and `targets` once per sea realisation; those of `view`
// and `radar` once per observation, one interval of one sea in one view; those of `clutter` once per map of an
// observation (dataset.maps_per_interval). Observations and their maps are common to all targets.
enum class DrawnPer { kSea, kObservation, kMap };
const char* name(DrawnPer per);  // "sea", "observation", "map"

// How often a key is drawn; nothing for one that must be common to all maps.
std::optional<DrawnPer> drawn_per(std::string_view key_path);

struct Variation {
  std::string key_path;
  Distribution distribution;
  DrawnPer per = DrawnPer::kSea;
  std::string drawn_as;  // key whose draws this one has: key_path itself, or KEY where same(KEY) is written

  // As written in a scenario, with commas.
  std::string text() const;
  // False for the two values of sea.scatter_diagram, whose keys are not in the scenario.
  bool is_written() const { return distribution.kind != DistributionKind::kScatter; }

  bool operator==(const Variation&) const = default;
};

// Numbers of a sea realisation, sea_key(), of an observation, and of a map of an observation.
struct DrawPlace {
  std::uint64_t sea = 0;
  std::uint64_t observation = 0;
  std::uint64_t map = 0;

  bool operator==(const DrawPlace&) const = default;
};

// The drawn keys of a document, by their paths. In the place of a distribution, same(KEY) gives a key the draws of KEY,
// which is drawn as often: twins with one layout in each sea; the document then has the value of a KEY that is written
// and not drawn. Records an error for a wrong distribution, for a key that
// must be common to all maps, and for same() of another key; such keys are not among the result.
std::vector<Variation> find_variations(ScenarioDocument& document, ErrorList& errors);

// Wave height and period drawn from a diagram, both from the same random numbers.
std::vector<Variation> scatter_variations(const std::shared_ptr<const ScatterDiagram>& diagram);

// The value of a variation at a place: keyed by (seed, kDraw, drawn_as and number), independent of all other keys.
ScalarValue drawn_value(const Variation& variation, std::uint64_t seed, const DrawPlace& place);

// The document with values[i], as written, in place of variations[i]; keys that are not written are added to their
// sections.
ScenarioDocument with_values(const ScenarioDocument& document, const std::vector<Variation>& variations,
                             const std::vector<std::string>& values);

}  // namespace seaglint

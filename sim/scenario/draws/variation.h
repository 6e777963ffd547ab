// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Keys of a scenario whose values are drawn from distributions, and the scenarios with the drawn values.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/scenario/draws/distribution.h"

namespace seaglint {

class ErrorList;
struct ScenarioDocument;

// How often a value is drawn: keys of `sea`, `sea_reflection` and `targets` once per sea realisation; those of `view`
// and `radar` once per observation, one interval of one sea in one view; those of `clutter` once per map of an
// observation (dataset.maps_per_interval). Observations and their maps are common to all targets.
enum class DrawnPer { kSea, kObservation, kMap };
const char* name(DrawnPer per);  // "sea", "observation", "map"

struct Variation {
  std::string key_path;
  Distribution distribution;
  DrawnPer per = DrawnPer::kSea;
  std::string drawn_as;  // key whose draws this one has: key_path itself, or KEY where same(KEY) is written

  // As written in a scenario, with commas.
  std::string text() const;
  // False for the two values of sea.scatter_diagram, whose keys are not in the scenario.
  bool is_written() const { return distribution.kind != DistributionKind::kScatter; }
};

// Numbers of a sea realisation, sea_key(), of an observation, and of a map of an observation.
struct DrawPlace {
  std::uint64_t sea = 0;
  std::uint64_t observation = 0;
  std::uint64_t map = 0;
};

// Gives keys that are same(KEY) the value of KEY where that is written and not drawn.
void copy_fixed_values(ScenarioDocument& document);

// The drawn keys of a document, by their paths. In the place of a distribution, same(KEY) gives a key the draws of KEY,
// which is drawn as often: twins with one layout in each sea. Records an error for a wrong distribution, for a key that
// must be common to all maps, and for same() of another key; such keys are not among the result.
std::vector<Variation> find_variations(const ScenarioDocument& document, ErrorList& errors);

// Wave height and period drawn from a diagram, both from the same random numbers.
std::vector<Variation> scatter_variations(const std::shared_ptr<const ScatterDiagram>& diagram);

// The value of a variation at a place: keyed by (seed, kDraw, drawn_as and number), independent of all other keys.
std::string drawn_value(const Variation& variation, std::uint64_t seed, const DrawPlace& place);

// The document with values[i] in place of variations[i]; keys that are not written are added to their sections.
ScenarioDocument with_values(const ScenarioDocument& document, const std::vector<Variation>& variations,
                             const std::vector<std::string>& values);

}  // namespace seaglint

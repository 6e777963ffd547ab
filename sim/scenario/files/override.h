// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Overrides of --set, inserted into a scenario before it is read.

#include <string>
#include <string_view>

namespace seaglint {

struct ScenarioDocument;

// Keys of a section that state one quantity, of which at most one is given. --set of one replaces another.
struct Alternatives {
  const char* section;
  std::string_view keys[5];  // empty: fewer
};
inline constexpr std::string_view kScatterDiagram = "scatter_diagram";  // gives heights and periods
inline constexpr Alternatives kAlternatives[] = {
    {"sea", {"peak_period_s", "energy_period_s", "zero_crossing_period_s", "steepness", kScatterDiagram}},
    {"sea", {"significant_wave_height_m", kScatterDiagram}},
    {"sea", {"propagation_deg", "coming_from_deg"}},
    {"sea.swell", {"peak_period_s", "energy_period_s", "zero_crossing_period_s"}},
    {"sea.swell", {"propagation_deg", "coming_from_deg"}},
};

// `key.path=value` of --set; the value is YAML and is checked like the file.
struct Override {
  std::string key_path;
  std::string value;
};

// Inserts an override into the tree. Missing maps on the path are created, so that the reader reports unknown keys.
// The alternatives of the key are removed.
void apply_override(ScenarioDocument& document, const Override& override_value);

}  // namespace seaglint

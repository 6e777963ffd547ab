// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Texts and helpers that the tests of scenario reading have in common.

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"
#include "tests/refusal.h"

namespace seaglint::testing_scenarios {

// The scenario of the project's description, verbatim.
inline const char* const kPaper = R"(seaglint: 1
name: paper
seed: 42
radar:   {carrier_ghz: 16, hop_count: 8, hop_step_mhz: 25, hop_code: random, bandwidth_mhz: 25, pulse_width_us: 36, sampling_mhz: 50,
          pri_us: 250, pulses: 256, polarisation: vv}
view:    {azimuth_deg: 10:170:10, elevation_deg: 2}
sea:     {significant_wave_height_m: [0.1, 1, 2], peak_period_s: 8, gamma: 3.3, propagation_deg: 120, order: 2}   # or peak_period_s: dnv_wind_sea
targets:
  ship:  {label: 1, mesh: assets/combatant_144m.glb, motion: {model: ship}}
  array: {label: 0, mesh: assets/icosahedral_reflector.glb, layout: {line: {count: 4, spacing_m: 40}}, motion: {model: float}}
clutter: {scr_db: 20, scr_definition: per_pulse}
map:     {range_span_m: 192}
dataset: {maps_per_case: 100, realisations_per_case: 10, interval_spacing_s: 10, split: 7:3}
learning: {fusion: split}
)";

// The shortest valid scenario, and the same with lines added.
inline const std::string kShort = "seaglint: 1\ntargets:\n  a: {label: 1, mesh: a.glb}\n";

inline Scenario parse(const std::string& yaml, const std::vector<Override>& overrides = {}) {
  return parse_scenario(yaml, "folder/file.yaml", overrides);
}

inline std::string complaint_about(const std::string& yaml, const std::vector<Override>& overrides = {}) {
  return refusal_of([&] { parse(yaml, overrides); });
}

}  // namespace seaglint::testing_scenarios

// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>

#include "sim/scenario/files/document.h"
#include "sim/scenario/material_spec.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tests/fuzz/readers.h"

namespace seaglint {
namespace {

const char* const kScenario = R"(seaglint: 1
radar: {carrier_ghz: 16, pulses: 64}
view: {azimuth_deg: [10, 80]}
sea: {significant_wave_height_m: [0.1, 1], peak_period_s: dnv_wind_sea}
targets:
  ship: {label: 1, mesh: a.glb, motion: {model: ship}}
  points: {label: 0, points: [{position_m: [0, 0, 0]}]}
)";

// The effective scenario reads back to itself.
void check_scenario(const Scenario& scenario) {
  const std::string yaml = effective_yaml(scenario);
  SEAGLINT_CHECK(effective_yaml(parse_scenario(yaml, "effective.yaml")) == yaml, yaml);
}

}  // namespace

void fuzz_yaml(const std::string& bytes) {
  is_refused([&] { parse_yaml(bytes, "file.yaml"); });
}

void fuzz_override(const std::string& bytes) {
  const std::size_t equals = bytes.find('=');
  if (equals == std::string::npos) return;
  is_refused([&] {
    check_scenario(parse_scenario(kScenario, "file.yaml", {{bytes.substr(0, equals), bytes.substr(equals + 1)}}));
  });
}

void fuzz_material(const std::string& bytes) {
  is_refused([&] { parse_material(bytes, "material.yaml"); });
}

void fuzz_scenario(const std::string& bytes) {
  is_refused([&] {
    const Scenario scenario = parse_scenario(bytes, "file.yaml");
    check_scenario(scenario);
    const SamplePlan plan(scenario);
  });
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/contradictions.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/constants.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

namespace {

void check_radar(const RadarSpec& radar, const ScenarioDocument& document) {
  if (radar.pulse_width_us >= radar.pri_us) {
    document.fail_at("radar.pulse_width_us", fmt::format("must be shorter than radar.pri_us, {}", radar.pri_us));
  }
  if (radar.bandwidth_mhz > radar.sampling_mhz) {
    document.fail_at("radar.bandwidth_mhz", fmt::format("must be at most radar.sampling_mhz, {}", radar.sampling_mhz));
  }
}

// Regular deep-water waves break at a steepness H/L of 1/7 (Michell 1893), L = g T^2 / (2 pi). A sea whose significant
// height lies beyond that at its peak period does not exist.
void check_sea(const SeaSpec& sea, const ScenarioDocument& document) {
  for (const SeaState& state : sea_states(sea)) {
    const double height = state.significant_wave_height_m;
    if (sea.dnv_wind_sea && height == 0) {
      document.fail_at("sea.significant_wave_height_m", "must be greater than 0 with peak_period_s: dnv_wind_sea");
    }
    const double wavelength = kGravity * state.peak_period_s * state.peak_period_s / (2 * kPi);
    if (height > wavelength / 7) {
      document.fail_at("sea.significant_wave_height_m",
                       fmt::format("waves of {} m break at a peak period of {} s: must be at most {:.4g} m", height,
                                   state.peak_period_s, wavelength / 7));
    }
  }
}

// A radar at or below the horizon has no image to see the target from; sea water's model ends at 90 GHz.
void check_sea_reflection(const Scenario& scenario, const ScenarioDocument& document) {
  if (!scenario.sea_reflection.enabled) return;
  for (const double elevation : scenario.view.elevation_deg) {
    if (elevation <= 0) document.fail_at("view.elevation_deg", "must be greater than 0 with sea_reflection");
  }
  if (scenario.sea_reflection.surface == SeaSurface::kSeaWater && scenario.radar.carrier_ghz > 89) {
    document.fail_at("radar.carrier_ghz", "must be at most 89 with sea_reflection of sea_water");
  }
}

void check_target(const TargetSpec& target, const ScenarioDocument& document) {
  const std::string path = "targets." + target.name;
  if (target.mesh.empty() && target.points.empty()) document.fail_at(path, "must have a mesh or points");
  if (target.points.empty()) return;
  if (!target.mesh.empty()) document.fail_at(path, "must have a mesh or points, not both");
  // Points carry their own velocity: a motion beside them would be ignored.
  const YamlNode* node = document.root.find("targets")->find(target.name);
  for (const char* key : {"unit", "material", "part_materials", "layout", "motion", "solver"}) {
    if (node->find(key) != nullptr)
      document.fail_at(fmt::format("{}.{}", path, key), "must not stand beside points, it belongs to a mesh");
  }
}

// The response of a mesh is that of a target at rest during a pulse; only ideal points carry the f/mu term in their
// echo.
void check_intra_pulse_motion(const Scenario& scenario, const ScenarioDocument& document) {
  if (!scenario.radar.intra_pulse_motion) return;
  for (const TargetSpec& target : scenario.targets) {
    if (!target.mesh.empty()) {
      document.fail_at(
          "radar.intra_pulse_motion",
          fmt::format("must be false with a mesh, here targets.{}: only points move during a pulse", target.name));
    }
  }
}

void check_dataset(const Scenario& scenario, const ScenarioDocument& document) {
  const DatasetSpec& dataset = scenario.dataset;
  if (dataset.maps_per_case % dataset.realisations_per_case != 0) {
    document.fail_at("dataset.maps_per_case", fmt::format("must be a multiple of dataset.realisations_per_case, {}",
                                                          dataset.realisations_per_case));
  }
}

// The product of all sweeps, as a number that cannot overflow.
void check_case_count(const Scenario& scenario, const ScenarioDocument& document) {
  constexpr double kMaxCases = 1e6;
  constexpr double kMaxMaps = 1e9;
  const SeaSpec& sea = scenario.sea;
  double cases = 1;
  for (const Sweep* sweep : {&scenario.view.azimuth_deg, &scenario.view.elevation_deg, &sea.significant_wave_height_m,
                             &sea.peak_period_s, &sea.gamma, &sea.propagation_deg}) {
    cases *= std::max(1.0, static_cast<double>(sweep->size()));
  }
  if (cases > kMaxCases)
    document.fail_at("view.azimuth_deg",
                     fmt::format("the sweeps of view and sea span {} cases: must be at most {}", cases, kMaxCases));
  const double maps = cases * scenario.dataset.maps_per_case * static_cast<double>(scenario.targets.size());
  if (maps > kMaxMaps)
    document.fail_at("dataset.maps_per_case", fmt::format("makes {} maps: must be at most {} in all", maps, kMaxMaps));
}

}  // namespace

void check_contradictions(const Scenario& scenario, const ScenarioDocument& document) {
  check_radar(scenario.radar, document);
  check_case_count(scenario, document);
  check_sea(scenario.sea, document);
  check_sea_reflection(scenario, document);
  for (const TargetSpec& target : scenario.targets) check_target(target, document);
  check_intra_pulse_motion(scenario, document);
  check_dataset(scenario, document);
}

}  // namespace seaglint

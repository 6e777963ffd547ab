// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

#include "sim/core/constants.h"
#include "sim/core/error.h"
#include "sim/core/file.h"
#include "sim/scenario/contradictions.h"
#include "sim/scenario/document.h"
#include "sim/scenario/reader.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

// What a scenario without a name is called: its file's name, of printable characters.
std::string name_of_file(const fs::path& file) {
  std::string name = file.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '_');
  return name.empty() ? "scenario" : name;
}

}  // namespace

Scenario read_scenario(const fs::path& file, const std::vector<Override>& overrides) {
  return parse_scenario(read_file(file, kMaxYamlBytes), file.string(), overrides);
}

Scenario parse_scenario(const std::string& yaml, const std::string& file_name, const std::vector<Override>& overrides) {
  ScenarioDocument document{file_name, {}, parse_yaml(yaml, file_name)};
  for (const Override& override_value : overrides) apply_override(document, override_value);
  Scenario scenario = read_fields(document);
  check_contradictions(scenario, document);
  scenario.folder = fs::path(file_name).parent_path();
  if (scenario.name.empty()) scenario.name = name_of_file(file_name);
  return scenario;
}

fs::path find_mesh(const Scenario& scenario, const TargetSpec& target) {
  const fs::path beside = scenario.folder / target.mesh;
  std::error_code error;
  for (const fs::path& candidate : {beside, fs::path(target.mesh)}) {
    if (fs::exists(candidate, error)) return candidate;
  }
  throw InputError(fmt::format("targets.{}.mesh: value '{}': no such file, neither {} nor below the working directory",
                               target.name, target.mesh, beside.string()));
}

std::vector<SeaState> sea_states(const SeaSpec& spec) {
  std::vector<SeaState> states;
  for (const double height : spec.significant_wave_height_m) {
    // Wind sea: Tp = 3.96 sqrt(Hs), between the 3.6 and 5 sqrt(Hs) where DNV-RP-C205, 3.5.5.5, finds JONSWAP to hold.
    const Sweep periods = spec.dnv_wind_sea ? Sweep{3.96 * std::sqrt(height)} : spec.peak_period_s;
    for (const double period : periods) {
      for (const double gamma : spec.gamma) {
        for (const double propagation : spec.propagation_deg) {
          SeaState state;
          state.significant_wave_height_m = height;
          state.peak_period_s = period;
          state.gamma = gamma;
          state.propagation_rad = radians(propagation);
          state.order = spec.order;
          state.components = spec.components;
          const double peak_rad_s = period > 0 ? 2 * kPi / period : 0;
          state.cutoff_rad_s = spec.cutoff_rad_s > 0 ? spec.cutoff_rad_s : std::max(8.0, 4 * peak_rad_s);
          // On flat water no component is too short for the expansion.
          const double convergent_rad_s = height > 0 ? std::sqrt(2 * kGravity / height) : state.cutoff_rad_s;
          state.second_order_cutoff_rad_s =
              spec.second_order_cutoff_rad_s > 0 ? spec.second_order_cutoff_rad_s : convergent_rad_s;
          states.push_back(state);
        }
      }
    }
  }
  return states;
}

std::vector<View> views(const ViewSpec& spec) {
  std::vector<View> all;
  for (const double azimuth : spec.azimuth_deg) {
    for (const double elevation : spec.elevation_deg) all.push_back({radians(azimuth), radians(elevation)});
  }
  return all;
}

}  // namespace seaglint

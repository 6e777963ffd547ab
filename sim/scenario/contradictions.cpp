// SPDX-License-Identifier: BSD-3-Clause
// Consistency of a scenario whose fields are individually valid.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dispersion.h"
#include "sim/core/process/error.h"
#include "sim/scenario/cases.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/layout/layout.h"

namespace seaglint {

void check_ship(const ShipSpec& ship) {
  const auto [lowest, highest, reference] = kShipLengths_m[static_cast<std::size_t>(ship.kind)];
  if (ship.loading && !(*ship.loading >= 0 && *ship.loading <= 1))
    throw InputError(fmt::format("loading: value {:g}: must be within 0 and 1", *ship.loading));
  const double length = ship.length_m;
  if (length == 0 || (length >= lowest && length <= highest)) return;  // written so that a NaN fails
  std::string others;
  for (std::size_t kind = 0; kind < std::size(kShipLengths_m); ++kind) {
    if (length >= kShipLengths_m[kind].lowest && length <= kShipLengths_m[kind].highest)
      others += fmt::format("{} {}", others.empty() ? "; kinds of that length:" : ",", kShipKindNames[kind]);
  }
  throw InputError(fmt::format("length_m: value {:g}: must be within {:g} and {:g} for a {}{}", length, lowest, highest,
                               kShipKindNames[static_cast<std::size_t>(ship.kind)], others));
}

namespace {

constexpr int kMinSamples = 8;  // of a pulse

void check_radar(const RadarSpec& radar, const ScenarioDocument& document, ErrorList& errors) {
  errors.check({"radar.pulse_width_us", "radar.pri_us"}, [&] {
    if (radar.pulse_width_us >= radar.pri_us)
      document.fail_at("radar.pulse_width_us", fmt::format("must be shorter than radar.pri_us, {}", radar.pri_us));
  });
  errors.check({"radar.bandwidth_mhz", "radar.sampling_mhz"}, [&] {
    if (radar.bandwidth_mhz > radar.sampling_mhz) {
      document.fail_at("radar.bandwidth_mhz",
                       fmt::format("must be at most radar.sampling_mhz, {}", radar.sampling_mhz));
    }
  });
  errors.check({"radar.bandwidth_mhz", "radar.carrier_ghz"}, [&] {
    if (!(lowest_ghz(radar) > 0)) {
      document.fail_at("radar.bandwidth_mhz",
                       fmt::format("must be below twice radar.carrier_ghz, {:g}", 2e3 * radar.carrier_ghz));
    }
  });
  // Fewer samples do not represent a chirp: the single sample of a shorter pulse would have the energy of a pulse of
  // one sample interval.
  errors.check({"radar.pulse_width_us", "radar.sampling_mhz"}, [&] {
    if (radar.pulse_width_us * radar.sampling_mhz < kMinSamples) {
      document.fail_at("radar.pulse_width_us", fmt::format("must be at least {:g} us, {} samples of radar.sampling_mhz",
                                                           kMinSamples / radar.sampling_mhz, kMinSamples));
    }
  });
}

// Pulses with jitter must not overlap; a hop code file requires hop_code: file.
void check_pulse_train(const RadarSpec& radar, const ScenarioDocument& document, ErrorList& errors) {
  errors.check({"radar.pri_jitter_us", "radar.pri_us", "radar.pulse_width_us"}, [&] {
    if (2 * radar.pri_jitter_us > radar.pri_us - radar.pulse_width_us) {
      document.fail_at("radar.pri_jitter_us",
                       fmt::format("pulses would overlap: must be at most (pri_us - pulse_width_us) / 2, {}",
                                   (radar.pri_us - radar.pulse_width_us) / 2));
    }
  });
  errors.check({"radar.hop_code_file", "radar.hop_code"}, [&] {
    const YamlNode* node = document.root.find("radar");
    const bool has_file = node != nullptr && node->find("hop_code_file") != nullptr;
    if (has_file && radar.hop_code != HopCode::kFile)
      document.fail_at("radar.hop_code_file", "not allowed here: valid only with hop_code: file");
    if (!has_file && radar.hop_code == HopCode::kFile) document.fail_at("radar.hop_code_file", "this key is missing");
  });
}

// The echo of the range window must end before the next pulse.
void check_window(const Scenario& scenario, const ScenarioDocument& document) {
  const RadarSpec& radar = scenario.radar;
  const double echo_us = echo_duration_us(radar, scenario.map.range_span_m);
  if (echo_us > radar.pri_us) {
    document.fail_at("map.range_span_m",
                     fmt::format("its echo lasts {:.6g} us with the pulse: must end within radar.pri_us, {}", echo_us,
                                 radar.pri_us));
  }
}

// Absolute clutter level and sea-state Doppler require grazing angles within the range of the reflectivity model.
void check_grazing(const Scenario& scenario, const ScenarioDocument& document) {
  const ClutterSpec& clutter = scenario.clutter;
  const bool own_level = is_absolute(clutter.level), own_motion = clutter.doppler != ClutterDoppler::kPrescribed;
  if (!clutter.enabled || !(own_level || own_motion)) return;
  const std::string where = own_level
                                ? fmt::format("level: {}", kClutterLevels[static_cast<std::size_t>(clutter.level)])
                            : clutter.doppler == ClutterDoppler::kSeaState ? "doppler: sea_state"
                                                                           : "doppler: wave_resolved";
  const ReflectivityRange range = reflectivity_range(clutter.level);
  for (const double elevation : scenario.view.elevation_deg) {
    if (elevation < range.lowest_deg || elevation > range.highest_deg)
      document.fail_at("view.elevation_deg", fmt::format("must be within {:g} and {:g} with clutter.{}",
                                                         range.lowest_deg, range.highest_deg, where));
  }
}

// Power that follows the waves belongs to scatterers that move with them.
void check_texture(const Scenario& scenario, const ScenarioDocument& document) {
  if (scenario.clutter.texture == ClutterTexture::kWaves && scenario.clutter.doppler != ClutterDoppler::kWaveResolved)
    document.fail_at("clutter.texture", "waves needs clutter.doppler: wave_resolved");
}

// The reflectivity model is valid within its range. `states`: all of the sweeps.
void check_clutter(const Scenario& scenario, const std::vector<SeaState>& states, const ScenarioDocument& document) {
  const ClutterSpec& clutter = scenario.clutter;
  if (!clutter.enabled || !is_absolute(clutter.level)) return;
  const RadarSpec& radar = scenario.radar;
  const std::string where =
      fmt::format("with clutter.level: {}", kClutterLevels[static_cast<std::size_t>(clutter.level)]);
  const ReflectivityRange range = reflectivity_range(clutter.level);
  if (radar.polarisation != Polarisation::kHh && radar.polarisation != Polarisation::kVv)
    document.fail_at("radar.polarisation", fmt::format("must be hh or vv {}", where));
  if (lowest_ghz(radar) < range.lowest_ghz || highest_ghz(radar) > range.highest_ghz) {
    document.fail_at("radar.carrier_ghz",
                     fmt::format("all carriers with their band, {:g} to {:g} GHz, must be within {:g} and {:g} {}",
                                 lowest_ghz(radar), highest_ghz(radar), range.lowest_ghz, range.highest_ghz, where));
  }
  if (clutter.sea_state && *clutter.sea_state < range.lowest_state)
    document.fail_at("clutter.sea_state", fmt::format("must be at least {:g} {}", range.lowest_state, where));
  for (const SeaState& state : states) {
    if (!clutter.sea_state && total_wave_height(state) > 6)
      document.fail_at("sea.significant_wave_height_m", fmt::format("must be at most 6 {}, sea state 6", where));
    constexpr double kStateOne_m = 0.1 / 1.5;  // height of sea state 1 (radar/echo/sea_reflectivity.h)
    if (!clutter.sea_state && range.lowest_state == 1 && total_wave_height(state) < kStateOne_m)
      document.fail_at("sea.significant_wave_height_m",
                       fmt::format("must be at least {:.3g} {}, sea state 1", kStateOne_m, where));
  }
}

// Keys that state one quantity: at most one of them. find_scatter_diagram() refuses what stands beside a diagram, whose
// drawn values do.
void check_alternatives(const ScenarioDocument& document) {
  for (const Alternatives& group : kAlternatives) {
    const YamlNode* section = &document.root;
    for (const std::string& key : split_path(group.section)) {
      if (section != nullptr) section = section->find(key);
    }
    if (section == nullptr) continue;
    std::string_view first;
    for (const std::string_view key : group.keys) {
      if (key.empty() || key == kScatterDiagram || section->find(key) == nullptr) continue;
      if (first.empty()) {
        first = key;
        continue;
      }
      document.fail_at(fmt::format("{}.{}", group.section, key),
                       fmt::format("not allowed here: valid only without {}.{}", group.section, first));
    }
  }
}

// Keys that do not apply to this spectrum are errors.
void check_spectrum(const SeaSpec& sea, const ScenarioDocument& document) {
  const YamlNode* node = document.root.find("sea");
  const auto is_given = [&](const char* key) { return node != nullptr && node->find(key) != nullptr; };
  const auto only = [&](const char* key, bool allowed, const char* with) {
    if (is_given(key) && !allowed) {
      document.fail_at(fmt::format("sea.{}", key), fmt::format("not allowed here: valid only with {}", with));
    }
  };
  const bool is_table = sea.spectrum == SpectrumKind::kTable;
  const bool is_jonswap = sea.spectrum == SpectrumKind::kJonswap || document.draws("sea.spectrum");
  only("table", is_table, "spectrum: table");
  only("table_time", is_table, "spectrum: table");
  only("peak_period_s", !is_table, "spectrum: jonswap or bretschneider; a table has its own peak");
  for (const char* other : {"energy_period_s", "zero_crossing_period_s", "steepness"})
    only(other, !is_table, "spectrum: jonswap or bretschneider; a table has its own peak");
  only("gamma", is_jonswap, "spectrum: jonswap");
  only("normalisation", is_jonswap, "spectrum: jonswap");
  only("wind", sea.period_rule == PeakPeriod::kWindAndFetch, "peak_period_s: wind_and_fetch");
  if (is_table && sea.table.empty()) document.fail_at("sea.table", "this key is missing");
  if (sea.height_rule == WaveHeight::kFromTable && !is_table) {
    document.fail_at("sea.significant_wave_height_m", "must be a number without spectrum: table");
  }
}

// The significant wave height must not exceed the breaking limit of a regular wave of the peak period.
void check_breaking(const std::string& key, double height, double period, double depth,
                    const ScenarioDocument& document) {
  const double highest = breaking_height(2 * kPi / period, depth);
  if (height > highest) {
    const std::string place = depth == kDeepWater ? "" : fmt::format(" in {} m of water", depth);
    document.fail_at(
        key, fmt::format("waves of {:.6g} m break at a peak period of {:.6g} s{}: must be at most {:.4g} m", height,
                         period, place, highest));
  }
}

// The peak period of a mean period has the bounds of a peak period that is given.
void check_mean_period(const std::string& section, bool energy, bool zero_crossing, double peak_period_s,
                       const ScenarioDocument& document) {
  constexpr double kShortest = 0.5, kLongest = 40;
  if (!(energy || zero_crossing) || (peak_period_s >= kShortest && peak_period_s <= kLongest)) return;
  document.fail_at(
      fmt::format("{}.{}", section, energy ? "energy_period_s" : "zero_crossing_period_s"),
      fmt::format("its peak period is {:.4g} s: must be within {} and {}", peak_period_s, kShortest, kLongest));
}

// A steepness gives a peak period within the bounds of the key.
void check_steepness(const SeaState& state, const ScenarioDocument& document) {
  if (state.significant_wave_height_m == 0)
    document.fail_at("sea.significant_wave_height_m", "must be greater than 0 with sea.steepness");
  if (state.peak_period_s < 0.5 || state.peak_period_s > 40) {
    document.fail_at("sea.steepness",
                     fmt::format("gives a peak period of {:.4g} s at {:.4g} m: must be within 0.5 and 40 s",
                                 state.peak_period_s, state.significant_wave_height_m));
  }
}

void check_sea(const SeaSpec& sea, const std::vector<SeaState>& states, const ScenarioDocument& document) {
  for (const SeaState& state : states) {
    const double height = state.significant_wave_height_m;
    check_mean_period("sea", !sea.energy_period_s.empty(), !sea.zero_crossing_period_s.empty(), state.peak_period_s,
                      document);
    check_mean_period("sea.swell", sea.swell.energy_period_s.has_value(), sea.swell.zero_crossing_period_s.has_value(),
                      state.swell.peak_period_s, document);
    if (sea.period_rule == PeakPeriod::kDnvWindSea && height == 0) {
      document.fail_at("sea.significant_wave_height_m", "must be greater than 0 with peak_period_s: dnv_wind_sea");
    }
    if (!sea.steepness.empty()) check_steepness(state, document);
    const WaveSystemState& swell = state.swell;
    check_breaking("sea.significant_wave_height_m", height, state.peak_period_s, state.depth_m, document);
    check_breaking("sea.swell.significant_wave_height_m", swell.significant_wave_height_m, swell.peak_period_s,
                   state.depth_m, document);
    const double peak = 2 * kPi / state.peak_period_s;
    if (state.cutoff_rad_s <= peak) {
      document.fail_at("sea.cutoff_rad_s",
                       fmt::format("must be above the peak, {:.4g} rad/s (four times the peak contains "
                                   "all but 0.4 % of the energy)",
                                   peak));
    }
    const double swell_peak = 2 * kPi / swell.peak_period_s;
    if (swell.significant_wave_height_m > 0 && state.cutoff_rad_s <= swell_peak) {
      document.fail_at("sea.swell.peak_period_s",
                       fmt::format("must be greater than {:.4g}, the period of the sea's cut-off, {:.4g} rad/s",
                                   2 * kPi / state.cutoff_rad_s, state.cutoff_rad_s));
    }
    const bool pairs =
        state.depth_m != kDeepWater || state.spreading.kind != Spreading::kNone || swell.significant_wave_height_m > 0;
    constexpr int kMaxPaired = 2048;
    if (pairs && state.order == 2 && state.components + swell.components > kMaxPaired) {
      document.fail_at(
          "sea.components",
          fmt::format("with those of the swell must be at most {} at order 2 in a sea of finite depth or of "
                      "several directions, whose cost grows with their square",
                      kMaxPaired));
    }
  }
}

// Propagation over the waves is computed at low grazing angles and to 40 GHz, in the waves that move the bodies.
void check_waves_between(const Scenario& scenario, const std::vector<SeaState>& states,
                         const ScenarioDocument& document) {
  const SeaReflectionSpec& reflection = scenario.sea_reflection;
  if (!reflection.enabled || reflection.surface_profile != SurfaceProfileKind::kWaves) return;
  const std::string_view with = "with sea_reflection.surface_profile: waves";
  constexpr double kHighest_deg = 10;
  const RadarSpec& radar = scenario.radar;
  for (const double elevation : scenario.view.elevation_deg) {
    if (elevation > kHighest_deg) document.fail_at("view.elevation_deg", fmt::format("must be at most 10 {}", with));
    // Of a moving radar until the end of the interval, towards the target at the worst.
    const auto [x, y, z] = radar.platform.velocity_mps;
    const double duration_s = radar.pulses * radar.pri_us * 1e-6, range_m = radar.range_km * 1e3;
    const double height_m = range_m * std::sin(radians(elevation)) + std::max(0.0, z) * duration_s,
                 level_m = range_m * std::cos(radians(elevation)) - std::hypot(x, y) * duration_s;
    if (height_m > level_m * std::tan(radians(kHighest_deg)) && std::hypot(x, y, z) > 0) {
      document.fail_at(
          "radar.platform.velocity_mps",
          fmt::format("at this speed towards the target the radar is above 10 deg of elevation at the end of "
                      "an interval of {:.4g} s from {:g} deg, not allowed {}",
                      duration_s, elevation, with));
    }
  }
  if (highest_ghz(scenario.radar) > 40)
    document.fail_at("radar.carrier_ghz", fmt::format("the highest carrier with its band must be at most 40 {}", with));
  if (reflection.paths != SeaPaths::kAll)
    document.fail_at("sea_reflection.paths", fmt::format("must be all {}, whose field is not divided", with));
  for (const SeaState& state : states) {
    if (total_wave_height(state) == 0)
      document.fail_at("sea.significant_wave_height_m", fmt::format("must be greater than 0 {}", with));
  }
  for (const TargetSpec& target : scenario.targets) {
    if (target.motion.waves == WaveSharing::kIndependent)
      document.fail_at(fmt::format("targets.{}.motion.waves", target.name), fmt::format("must be same_field {}", with));
  }
}

// The sea reflection requires a radar above the horizon; the sea-water model is valid to 90 GHz.
void check_sea_reflection(const Scenario& scenario, const ScenarioDocument& document) {
  if (!scenario.sea_reflection.enabled) return;
  for (const double elevation : scenario.view.elevation_deg) {
    if (elevation <= 0) document.fail_at("view.elevation_deg", "must be greater than 0 with sea_reflection");
    // A moving radar must remain above it until the end of the interval.
    const RadarSpec& radar = scenario.radar;
    const double sunk_m = -radar.platform.velocity_mps[2] * radar.pulses * radar.pri_us * 1e-6;
    const double height_m = radar.range_km * 1e3 * std::sin(radians(elevation));
    if (sunk_m >= height_m) {
      document.fail_at("radar.platform.velocity_mps",
                       fmt::format("value {:g} upwards: the radar sinks {:.4g} m in an interval, must be less than its "
                                   "height, {:.4g} m, with sea_reflection",
                                   radar.platform.velocity_mps[2], sunk_m, height_m));
    }
  }
  if (scenario.sea_reflection.surface == SeaSurface::kSeaWater && highest_ghz(scenario.radar) > 89) {
    document.fail_at("radar.carrier_ghz",
                     "the highest carrier with its band must be at most 89 with sea_reflection of sea_water");
  }
}

// All targets of one map have the same wavefront range; points, which have no such key, are in the far field.
void check_one_range(const TargetSpec& target, const TargetSpec& companion, const ScenarioDocument& document) {
  const double range_m = target.solver.wavefront_range_m, other_m = companion.solver.wavefront_range_m;
  if (range_m == other_m) return;
  const auto key = [](const TargetSpec& of) { return fmt::format("targets.{}.solver.wavefront_range_m", of.name); };
  const TargetSpec &wrong = companion.points.empty() ? companion : target,
                   &right = companion.points.empty() ? target : companion;
  document.fail_at(key(wrong), fmt::format("must be {}, as targets.{} has it in the same maps ({})",
                                           right.solver.wavefront_range_m, right.name, document.place_of(key(right))));
}

const char* model_name(const TargetSpec& target) {
  return kMotionModelNames[static_cast<std::size_t>(target.motion.model)];
}

// A target under way tows what has no motion of its own through the water.
void check_towed(const TargetSpec& host, const TargetSpec& towed, std::size_t companion,
                 const ScenarioDocument& document) {
  if (!host.companions[companion].towed) return;
  const std::string key = fmt::format("targets.{}.companions.{}.towed", host.name, companion);
  const auto moves_by_itself = [](const TargetSpec& target) {
    return has_mesh(target) && target.motion.model != MotionModel::kFixed && target.motion.model != MotionModel::kFloat;
  };
  if (!moves_by_itself(host) || (host.motion.model != MotionModel::kShip && !(host.motion.speed_mps > 0)))
    document.fail_at(key, fmt::format("not allowed here: targets.{} has no motion.speed_mps", host.name));
  if (moves_by_itself(towed)) {
    document.fail_at(key, fmt::format("not allowed here: targets.{0} is of model {1}, which has a speed of its own, "
                                      "targets.{0}.motion.speed_mps {2:g}",
                                      towed.name, model_name(towed), towed.motion.speed_mps));
  }
  if (towed.motion.drift) {
    document.fail_at(
        key, fmt::format("not allowed here: targets.{}.motion.drift is the velocity of a free float", towed.name));
  }
}

// A companion is another target of the file, without companions of its own.
void check_companions(const Scenario& scenario, const TargetSpec& target, const ScenarioDocument& document) {
  for (std::size_t i = 0; i < target.companions.size(); ++i) {
    const std::string key = fmt::format("targets.{}.companions.{}.target", target.name, i);
    const auto found = std::find_if(scenario.targets.begin(), scenario.targets.end(),
                                    [&](const TargetSpec& other) { return other.name == target.companions[i].target; });
    if (found == scenario.targets.end() || found->name == target.name)
      document.fail_at(key, "must be the name of another target");
    if (!found->companions.empty()) document.fail_at(key, "must be a target without companions of its own");
    check_one_range(target, *found, document);
    check_towed(target, *found, i, document);
  }
}

// A part has no samples, and a companion no companions of its own.
void check_roles(const Scenario& scenario, const ScenarioDocument& document) {
  const auto is_part = [](const TargetSpec& target) { return target.role == TargetRole::kPart; };
  if (std::ranges::all_of(scenario.targets, is_part))
    document.fail_at("targets", "must have a target of role: class; parts have no samples of their own");
  for (const TargetSpec& target : scenario.targets) {
    if (is_part(target) && !target.companions.empty()) {
      document.fail_at(fmt::format("targets.{}.companions", target.name),
                       "not allowed here: valid only with role: class");
    }
  }
}

// The frame of a target under way moves with it relative to the water; a float and a fixed body have no speed.
void check_speed(const TargetSpec& target, const ScenarioDocument& document) {
  const MotionModel model = target.motion.model;
  if (target.motion.speed_mps > 0 && (model == MotionModel::kFixed || model == MotionModel::kFloat)) {
    document.fail_at(fmt::format("targets.{}.motion.speed_mps", target.name),
                     fmt::format("must be 0 with model: {}, which stays where it is in the water", model_name(target)));
  }
}

// Wind and current carry floats; ropes join the neighbours of a line of free floats that drift together.
void check_drift_and_ropes(const TargetSpec& target, const ScenarioDocument& document) {
  const std::string path = "targets." + target.name;
  const MotionSpec& motion = target.motion;
  if (motion.drift && motion.model != MotionModel::kFloat) {
    document.fail_at(path + ".motion.drift",
                     fmt::format("not allowed here: valid only with model: float, not {}", model_name(target)));
  }
  if (!target.layout || !target.layout->tether_slack) return;
  const std::string key = path + ".layout.tether_slack", only = "not allowed here: valid only with ";
  if (!target.layout->line) document.fail_at(key, only + "line");
  if (is_raft(target.layout)) document.fail_at(key, only + "bodies: independent");
  if (motion.model != MotionModel::kFloat)
    document.fail_at(key, fmt::format("{}{}.motion.model: float, not {}", only, path, model_name(target)));
  if (!motion.translations) document.fail_at(key, fmt::format("{}{}.motion.translations: true", only, path));
  if (motion.drift && motion.drift->spread_mps > 0)
    document.fail_at(path + ".motion.drift.spread_mps", "must be 0 with layout.tether_slack: a line drifts as a whole");
}

// Beams have no distance between them.
void check_solver(const TargetSpec& target, const ScenarioDocument& document) {
  const std::string path = fmt::format("targets.{}.solver", target.name);
  if (target.solver.method == SolverMethod::kBeams && target.solver.ray_spacing_m != 0 &&
      !document.draws(path + ".method")) {
    document.fail_at(path + ".ray_spacing_m", "valid only with method: rays; beams have min_patch_m");
  }
}

void check_layout(const TargetSpec& target, const ScenarioDocument& document) {
  if (!target.layout) return;
  const std::string path = fmt::format("targets.{}.layout", target.name);
  if (target.layout->line && target.layout->area) document.fail_at(path, "must have line or area, not both");
  const auto ordered = [&](const std::optional<BodyRange>& range, const char* lowest) {
    if (!range || range->lowest <= range->highest) return;
    document.fail_at(path + lowest, fmt::format("must be at most {}, the highest", range->highest));
  };
  ordered(target.layout->heights_m, ".heights.lowest_m");
  ordered(target.layout->headings_deg, ".headings.lowest_deg");
  ordered(target.layout->scales, ".scales.lowest");
  try {
    layout_positions(target.layout);
  } catch (const InputError& error) {
    document.fail_at(path + ".area", error.what());
  }
}

// A generated mesh has its own unit, axes and place.
void check_generated(const TargetSpec& target, const ScenarioDocument& document) {
  if (!is_generated(target)) return;
  const std::string path = "targets." + target.name;
  try {
    if (target.ship) check_ship(*target.ship);
  } catch (const InputError& error) {
    document.fail_at(path + ".ship", error.what());
  }
  const YamlNode* node = document.root.find("targets")->find(target.name);
  for (const char* key : {"unit", "orientation", "offset_m"}) {
    if (node->find(key) != nullptr)
      document.fail_at(fmt::format("{}.{}", path, key), "not allowed here: valid only with a mesh file");
  }
  const MotionSpec& motion = target.motion;
  if (target.ship && motion.model == MotionModel::kFloat && motion.origin_above_waterline_m != 0)
    document.fail_at(path + ".motion.origin_above_waterline_m",
                     "must be 0 for a generated ship, whose origin is on the waterline");
  if (!target.decoy || target.decoy->support == DecoySupport::kNone) return;
  const std::string support = path + ".decoy.support";
  if (motion.model != MotionModel::kFloat && (!is_raft(target.layout) || motion.model == MotionModel::kFixed))
    document.fail_at(support, fmt::format("must be none with motion.model: {}: a support floats", model_name(target)));
  if (motion.origin_above_waterline_m <= 0)
    document.fail_at(path + ".motion.origin_above_waterline_m", "must be above 0 with decoy.support");
  if (target.layout && (target.layout->heights_m || target.layout->scales))
    document.fail_at(support, "must be none with layout.heights or layout.scales: all supports have one height");
}

void check_target(const TargetSpec& target, const ScenarioDocument& document) {
  if (document.root.find("targets")->find(target.name) == nullptr) return;  // the sea alone
  const std::string path = "targets." + target.name;
  if (target.forward.back() == target.up.back())
    document.fail_at(path + ".orientation", fmt::format("forward {} and up {} must be perpendicular to each other",
                                                        target.forward, target.up));
  check_layout(target, document);
  check_speed(target, document);
  check_drift_and_ropes(target, document);
  check_solver(target, document);
  const int kinds =
      (target.mesh.empty() ? 0 : 1) + (target.ship ? 1 : 0) + (target.decoy ? 1 : 0) + (target.points.empty() ? 0 : 1);
  if (kinds != 1)
    document.fail_at(
        path, fmt::format("must have a mesh, a ship, a decoy or points{}", kinds == 0 ? "" : ", one of them only"));
  check_generated(target, document);
  if (target.points.empty()) return;
  // Points have velocities of their own: a motion section is an error.
  const YamlNode* node = document.root.find("targets")->find(target.name);
  for (const char* key : {"unit", "scale", "orientation", "offset_m", "material", "part_materials",
                          "sheet_thickness_mm", "layout", "motion", "solver"}) {
    if (node->find(key) != nullptr)
      document.fail_at(fmt::format("{}.{}", path, key), "not allowed here: valid only with a mesh");
  }
}

// The response of a mesh assumes a target at rest during a pulse; only ideal points have the f/mu term in their echo.
void check_intra_pulse_motion(const Scenario& scenario, const ScenarioDocument& document) {
  if (!scenario.radar.intra_pulse_motion) return;
  for (const TargetSpec& target : scenario.targets) {
    if (has_mesh(target)) {
      document.fail_at(
          "radar.intra_pulse_motion",
          fmt::format("must be false with a mesh, here targets.{}: only points move during a pulse", target.name));
    }
  }
}

// The sea alone has an absolute level, and an echo.
void check_sea_alone(const Scenario& scenario, const ScenarioDocument& document) {
  if (!is_sea_alone(scenario)) return;
  const ClutterSpec& clutter = scenario.clutter;
  if (clutter.enabled && !is_absolute(clutter.level)) {
    document.fail_at("clutter.level", "must be nrl, git, hyb or tsc with targets: {}; scr is a ratio to a target");
  }
  if (clutter.noise_level == NoiseLevel::kSnr)
    document.fail_at("clutter.noise_level", "must be cnr or thermal with targets: {}; snr is a ratio to a target");
  if (!clutter.enabled && clutter.noise_level == NoiseLevel::kCnr) {
    document.fail_at("clutter.enabled",
                     "must be true, or noise_level thermal, with targets: {}; nothing else has an echo");
  }
}

void check_labels(const Scenario& scenario, const ScenarioDocument& document) {
  const std::vector<std::string>& classes = scenario.dataset.classes;
  for (const TargetSpec& target : scenario.targets) {
    if (target.role == TargetRole::kPart || target.label < static_cast<int>(classes.size())) continue;
    document.fail_at(
        fmt::format("targets.{}.label", target.name),
        fmt::format("must be {}{}, a class of dataset.classes: {}", classes.size() == 2 ? "0 or " : "within 0 and ",
                    classes.size() - 1, fmt::join(classes, ", ")));
  }
}

void check_dataset(const Scenario& scenario, const ScenarioDocument& document) {
  const DatasetSpec& dataset = scenario.dataset;
  if (dataset.maps_per_case % dataset.realisations_per_case != 0) {
    document.fail_at("dataset.maps_per_case", fmt::format("must be a multiple of dataset.realisations_per_case, {}",
                                                          dataset.realisations_per_case));
  }
  if (dataset.maps_per_case / dataset.realisations_per_case % dataset.maps_per_interval != 0) {
    document.fail_at("dataset.maps_per_case",
                     fmt::format("must be a multiple of dataset.realisations_per_case, {}, times "
                                 "dataset.maps_per_interval, {}",
                                 dataset.realisations_per_case, dataset.maps_per_interval));
  }
}

// Looks follow one another, and the next interval of the realisation follows the last of them.
void check_looks(const Scenario& scenario, const ScenarioDocument& document) {
  const LookSpec& looks = scenario.looks;
  const DatasetSpec& dataset = scenario.dataset;
  if (looks.count == 1) return;
  const double interval_s = 1e-6 * scenario.radar.pulses * scenario.radar.pri_us;
  if (!(looks.spacing_s >= interval_s))
    document.fail_at(
        "looks.spacing_s",
        fmt::format("must be at least {:g}, the length of a look (radar.pulses times radar.pri_us)", interval_s));
  const bool has_next = dataset.maps_per_case > dataset.realisations_per_case * dataset.maps_per_interval;
  if (has_next && !(looks.last_start_s() + interval_s <= dataset.interval_spacing_s))
    document.fail_at(
        "dataset.interval_spacing_s",
        fmt::format("must be at least {:g}, the time of all looks of a sample", looks.last_start_s() + interval_s));
}

// Equal directions would give equal cases.
void check_directions(const std::string& key, const Sweep& values_deg, const ScenarioDocument& document) {
  constexpr double kSame = 1e-9;                      // deg, above the rounding of a full turn
  std::vector<std::pair<double, double>> directions;  // reduced to one turn; as given
  for (const double value : values_deg) directions.emplace_back(value - 360 * std::floor((value + kSame) / 360), value);
  std::sort(directions.begin(), directions.end());
  for (std::size_t i = 1; i < directions.size(); ++i) {
    if (directions[i].first - directions[i - 1].first > kSame) continue;
    const auto [lower, higher] = std::minmax(directions[i].second, directions[i - 1].second);
    document.fail_at(key, fmt::format("{} and {} are the same direction: list it once", lower, higher));
  }
}

constexpr double kMaxCases = 1e6;

// Products of sweep lengths in floating point, which does not overflow.
double product_of_lengths(std::initializer_list<const Sweep*> sweeps) {
  double product = 1;
  for (const Sweep* sweep : sweeps) product *= std::max(1.0, static_cast<double>(sweep->size()));
  return product;
}

double sea_count(const SeaSpec& sea) {
  return product_of_lengths({&sea.significant_wave_height_m, &sea.peak_period_s, &sea.energy_period_s,
                             &sea.zero_crossing_period_s, &sea.steepness, &sea.gamma, &sea.propagation_deg,
                             &sea.coming_from_deg});
}

double case_count(const Scenario& scenario) {
  return sea_count(scenario.sea) * product_of_lengths({&scenario.view.azimuth_deg, &scenario.view.elevation_deg});
}

void check_case_count(const Scenario& scenario, const ScenarioDocument& document) {
  const double cases = case_count(scenario);
  if (cases > kMaxCases)
    document.fail_at("view.azimuth_deg",
                     fmt::format("the sweeps of view and sea span {} cases: must be at most {}", cases, kMaxCases));
}

void check_map_count(const Scenario& scenario, const ScenarioDocument& document) {
  constexpr double kMaxMaps = 1e9;
  const auto classes = std::ranges::count(scenario.targets, TargetRole::kClass, &TargetSpec::role);
  const double maps = case_count(scenario) * scenario.dataset.maps_per_case * static_cast<double>(classes);
  if (maps > kMaxMaps)
    document.fail_at("dataset.maps_per_case", fmt::format("makes {} maps: must be at most {} in all", maps, kMaxMaps));
}

}  // namespace

void check_parts(const Scenario& scenario, const std::set<std::string>& companions, const ScenarioDocument& document) {
  for (const TargetSpec& target : scenario.targets) {
    if (target.role == TargetRole::kPart && !companions.contains(target.name)) {
      document.fail_at(fmt::format("targets.{}.role", target.name),
                       "must be the companion of another target, or class");
    }
  }
}

void check_contradictions(const Scenario& scenario, const ScenarioDocument& document, ErrorList& errors) {
  check_radar(scenario.radar, document, errors);
  check_pulse_train(scenario.radar, document, errors);
  errors.check({"map.range_span_m", "radar.pulse_width_us", "radar.pri_us"}, [&] { check_window(scenario, document); });
  errors.check({"view.elevation_deg", "clutter"}, [&] { check_grazing(scenario, document); });
  errors.check({"clutter"}, [&] { check_texture(scenario, document); });
  errors.check({"view", "sea"}, [&] { check_case_count(scenario, document); });
  errors.check({"view", "sea", "targets", "dataset.maps_per_case"}, [&] { check_map_count(scenario, document); });
  errors.check({"view.azimuth_deg"},
               [&] { check_directions("view.azimuth_deg", scenario.view.azimuth_deg, document); });
  errors.check({"sea"}, [&] { check_alternatives(document); });
  errors.check({"sea"}, [&] { check_spectrum(scenario.sea, document); });
  if (!errors.concerns("sea") && sea_count(scenario.sea) <= kMaxCases) {
    const std::vector<SeaState> states = sea_states(scenario.sea);
    errors.check({"clutter", "radar.polarisation", "radar.carrier_ghz", "radar.bandwidth_mhz", "radar.hop_count",
                  "radar.hop_step_mhz"},
                 [&] { check_clutter(scenario, states, document); });
    errors.check({"sea"}, [&] { check_sea(scenario.sea, states, document); });
    errors.check({"sea_reflection", "view.elevation_deg", "radar", "targets"},
                 [&] { check_waves_between(scenario, states, document); });
  }
  errors.check({"sea.propagation_deg"},
               [&] { check_directions("sea.propagation_deg", scenario.sea.propagation_deg, document); });
  errors.check({"sea.coming_from_deg"},
               [&] { check_directions("sea.coming_from_deg", scenario.sea.coming_from_deg, document); });
  errors.check({"sea_reflection", "view.elevation_deg", "radar"}, [&] { check_sea_reflection(scenario, document); });
  for (const TargetSpec& target : scenario.targets) {
    const std::string path = "targets." + target.name;
    errors.check({path}, [&] { check_target(target, document); });
  }
  errors.check({"targets"}, [&] {
    for (const TargetSpec& target : scenario.targets) check_companions(scenario, target, document);
  });
  errors.check({"targets"}, [&] { check_roles(scenario, document); });
  errors.check({"targets", "dataset.classes"}, [&] { check_labels(scenario, document); });
  errors.check({"targets", "clutter.level", "clutter.noise_level", "clutter.enabled"},
               [&] { check_sea_alone(scenario, document); });
  errors.check({"targets", "radar.intra_pulse_motion"}, [&] { check_intra_pulse_motion(scenario, document); });
  errors.check({"dataset.maps_per_case", "dataset.realisations_per_case", "dataset.maps_per_interval"},
               [&] { check_dataset(scenario, document); });
  errors.check({"looks", "radar.pulses", "radar.pri_us", "dataset"}, [&] { check_looks(scenario, document); });
}

}  // namespace seaglint

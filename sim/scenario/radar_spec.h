// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The `radar`, `view`, `clutter`, `map` and `looks` sections of a scenario, in the units of their keys. Defaults are
// the paper's radar. Meaning, unit and bound of each key stand in the table of fields (sim/scenario/fields.cpp,
// `seaglint keys`).

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/scenario/files/tables.h"

namespace seaglint {

enum class HopCode { kRandom, kBalanced, kStepped, kFile };
enum class Polarisation { kHh, kHv, kVh, kVv };  // first letter received, second transmitted

// Quantities of the radar equation, for clutter and noise levels that are not given as a ratio.
struct LinkBudgetSpec {
  double beamwidth_deg = 1.5;
  double peak_power_kw = 10;
  double antenna_gain_db = 40;
  double noise_figure_db = 4;
  double losses_db = 6;
  double reference_temperature_k = 290;

  bool operator==(const LinkBudgetSpec&) const = default;
};

// Motion of the radar relative to the fixed reference point of the target; the line of sight rotates as the radar
// moves.
struct PlatformSpec {
  std::array<double, 3> velocity_mps{0, 0, 0};
  bool motion_compensated = true;

  bool operator==(const PlatformSpec&) const = default;
};

inline constexpr int kMaxPulses = 1 << 20;  // of an interval; its echo is bounded by memory (make_pulse_train())
struct RadarSpec {
  double carrier_ghz = 16;
  int carrier_count = 8;
  double hop_step_mhz = 25;
  HopCode hop_code = HopCode::kRandom;
  std::string hop_code_file;
  FileContents<std::vector<int>> hop_codes;  // contents of that file
  double bandwidth_mhz = 25;
  double pulse_width_us = 36;
  double sampling_mhz = 50;
  double pri_us = 250;
  double pri_jitter_us = 0;
  int pulses = 256;
  Polarisation polarisation = Polarisation::kVv;
  bool intra_pulse_motion = false;
  double range_km = 20;
  LinkBudgetSpec link_budget;
  PlatformSpec platform;

  bool operator==(const RadarSpec&) const = default;
};

// Band edges of all carriers, GHz.
inline double lowest_ghz(const RadarSpec& radar) { return radar.carrier_ghz - 0.5e-3 * radar.bandwidth_mhz; }
inline double highest_ghz(const RadarSpec& radar) {
  return radar.carrier_ghz + 1e-3 * ((radar.carrier_count - 1) * radar.hop_step_mhz + 0.5 * radar.bandwidth_mhz);
}

using Sweep = std::vector<double>;  // a number, a list, or from:to:step in the file

struct ViewSpec {
  Sweep azimuth_deg{0};
  Sweep elevation_deg{2};

  bool operator==(const ViewSpec&) const = default;
};

enum class ScrDefinition { kPerPulse, kPeakCell, kExtent };

// kScr: relative to the target. Others: absolute, by the mean reflectivity of the sea by this model
// (radar/echo/sea_reflectivity.h), the range and the antenna beam.
enum class ClutterLevel { kScr, kNrl, kGit, kHyb, kTsc };
inline constexpr const char* kClutterLevels[] = {"scr", "nrl", "git", "hyb", "tsc"};
inline bool is_absolute(ClutterLevel level) { return level != ClutterLevel::kScr; }

// Where a model of the reflectivity is valid: frequencies, grazing angles, Douglas sea states.
struct ReflectivityRange {
  double lowest_ghz, highest_ghz, lowest_deg, highest_deg, lowest_state, highest_state;
};
inline ReflectivityRange reflectivity_range(ClutterLevel model) {
  if (model == ClutterLevel::kGit) return {1, 100, 0.1, 10, 1, 6};
  if (model == ClutterLevel::kHyb) return {0.5, 35, 0.1, 30, 1, 6};
  if (model == ClutterLevel::kTsc) return {0.5, 35, 0.1, 60, 1, 6};
  return {0.5, 35, 0.1, 60, 0, 6};
}
// kCnr: relative to the clutter. kSnr: relative to the target. kThermal: by the radar equation.
enum class NoiseLevel { kCnr, kSnr, kThermal };
// Contribution of the waves to the prescribed mean and spread of the velocity. kPrescribed: none. kSeaState: mean and
// spread for the sea state. kWaveResolved: mean for the sea state, and per scatterer the velocity of the water at its
// position in the sea realisation of the target.
enum class ClutterDoppler { kPrescribed, kSeaState, kWaveResolved };
// Local power of the sea. kIndependent: a random texture independent of the waves. kWaves: modulated by the waves that
// move the scatterers.
enum class ClutterTexture { kIndependent, kWaves };

// Absent values: by the scene (radar/echo/clutter_scene.h, texture_parameters).
struct ClutterSpec {
  ClutterLevel level = ClutterLevel::kScr;
  double scr_db = 20;
  ScrDefinition scr_definition = ScrDefinition::kPerPulse;
  bool enabled = true;
  NoiseLevel noise_level = NoiseLevel::kCnr;
  double cnr_db = 30;
  double snr_db = 20;
  std::optional<ClutterTexture> texture;
  std::optional<double> texture_shape;
  std::optional<double> texture_correlation_time_s;
  std::optional<double> texture_correlation_m;
  ClutterDoppler doppler = ClutterDoppler::kPrescribed;
  double doppler_mean_mps = 0;
  std::optional<double> doppler_spread_mps;
  double hh_velocity_factor = 1.5;
  std::optional<double> sea_state;

  bool operator==(const ClutterSpec&) const = default;
};
inline bool texture_is_by_waves(const ClutterSpec& clutter) {
  return clutter.texture.value_or(clutter.doppler == ClutterDoppler::kWaveResolved
                                      ? ClutterTexture::kWaves
                                      : ClutterTexture::kIndependent) == ClutterTexture::kWaves;
}

enum class Compression { kInverse, kMatched };
enum class Taper { kNone, kHann, kHamming, kTaylor };

struct MapSpec {
  double range_span_m = 192;
  double velocity_span_mps = 9.375;
  double range_oversampling = 1;
  double velocity_oversampling = 1;
  Compression compression = Compression::kInverse;
  Taper range_taper = Taper::kHann;
  Taper velocity_taper = Taper::kNone;
  bool clean = false;

  bool operator==(const MapSpec&) const = default;
};

// Coherent intervals of one sample, which the radar takes of one target in one sea.
struct LookSpec {
  int count = 1;
  double spacing_s = 0.5;  // from the start of one to that of the next

  double last_start_s() const { return (count - 1) * spacing_s; }
  bool operator==(const LookSpec&) const = default;
};

}  // namespace seaglint

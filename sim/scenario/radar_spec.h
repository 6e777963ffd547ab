// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The `radar`, `view`, `clutter` and `map` sections of a scenario, in the units of their keys. Defaults are the paper's
// radar; the inequality beside a field is checked by the reader (sim/scenario/fields.cpp).

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace seaglint {

enum class HopCode { kRandom, kBalanced, kStepped, kFile };
enum class Polarisation { kHh, kHv, kVh, kVv };  // first letter received, second transmitted

// Quantities of the radar equation, for clutter and noise levels that are not given as a ratio.
struct LinkBudgetSpec {
  double beamwidth_deg = 1.5;            // of the antenna in azimuth, one way at half power, 0.01 <= x <= 60
  double peak_power_kw = 10;             // 1e-6 <= x <= 1e5
  double antenna_gain_db = 40;           // 0 <= x <= 70
  double noise_figure_db = 4;            // 0 <= x <= 40
  double losses_db = 6;                  // 0 <= x <= 60
  double reference_temperature_k = 290;  // T_0 of the noise power k T_0 F per hertz, 1 <= x <= 10000
};

// Motion of the radar relative to the fixed reference point of the target; the line of sight rotates as the radar
// moves.
struct PlatformSpec {
  std::array<double, 3> velocity_mps{0, 0, 0};  // target frame, |x| <= 1000
  bool motion_compensated = true;  // own radial motion relative to the reference point removed from the echo
};

struct RadarSpec {
  double carrier_ghz = 16;              // lowest carrier, 0.1 <= x <= 300
  int carrier_count = 8;                // number of carriers M, 1 <= x <= 1024
  double hop_step_mhz = 25;             // carrier spacing, > 0
  HopCode hop_code = HopCode::kRandom;  // random (independent, as in the paper), balanced, stepped, file
  std::string hop_code_file;            // of hop_code: file, in the scenario's folder or the working directory
  std::shared_ptr<const std::vector<int>> hop_codes;  // contents of that file; at least `pulses` codes
  double bandwidth_mhz = 25;                          // LFM bandwidth B, 0.001 <= x <= 10000
  double pulse_width_us = 36;                         // 0.001 <= x <= 1e6, shorter than pri_us
  double sampling_mhz = 50;                           // complex sampling of the time-domain echo, >= bandwidth_mhz
  double pri_us = 250;                                // 0.01 <= x <= 1e7
  // uniform jitter within +- this, all pulses but the first; pulses must not overlap
  double pri_jitter_us = 0;
  int pulses = 256;  // of one coherent interval, 1 <= x <= 65536
  Polarisation polarisation = Polarisation::kVv;
  // the f/mu term of Doppler inside the pulse, in echo and map; only with points as targets
  bool intra_pulse_motion = false;
  double range_km = 20;  // to the target's reference point, for link budget and platform, 0.1 <= x <= 1000
  LinkBudgetSpec link_budget;
  PlatformSpec platform;
};

// Band edges of all carriers, GHz.
inline double lowest_ghz(const RadarSpec& radar) { return radar.carrier_ghz - 0.5e-3 * radar.bandwidth_mhz; }
inline double highest_ghz(const RadarSpec& radar) {
  return radar.carrier_ghz + 1e-3 * ((radar.carrier_count - 1) * radar.hop_step_mhz + 0.5 * radar.bandwidth_mhz);
}

using Sweep = std::vector<double>;  // a number, a list, or from:to:step in the file

struct ViewSpec {
  Sweep azimuth_deg{0};    // direction to the radar in the target frame, -360 <= x <= 360
  Sweep elevation_deg{2};  // of the radar seen from the target, -90 <= x <= 90
};

enum class ScrDefinition { kPerPulse, kPeakCell, kExtent };

// kScr: relative to the target. kNrl: absolute, by the mean reflectivity of the sea, the range and the antenna beam.
enum class ClutterLevel { kScr, kNrl };
// kCnr: relative to the clutter. kSnr: relative to the target. kThermal: by the radar equation.
enum class NoiseLevel { kCnr, kSnr, kThermal };
// Contribution of the waves to the prescribed mean and spread of the velocity. kPrescribed: none. kSeaState: mean and
// spread for the sea state. kWaveResolved: mean for the sea state, and per scatterer the velocity of the water at its
// position in the sea realisation of the target.
enum class ClutterDoppler { kPrescribed, kSeaState, kWaveResolved };

struct ClutterSpec {
  ClutterLevel level = ClutterLevel::kScr;
  double scr_db = 20;  // signal-to-clutter ratio, -60 <= x <= 200; where the level is scr
  ScrDefinition scr_definition = ScrDefinition::kPerPulse;
  bool enabled = true;
  NoiseLevel noise_level = NoiseLevel::kCnr;
  double cnr_db = 30;                     // clutter-to-noise ratio, -60 <= x <= 200; where noise_level is cnr
  double snr_db = 20;                     // target to noise, per pulse, -100 <= x <= 200; where noise_level is snr
  double texture_shape = 2;               // shape of the K distribution's gamma texture, 0.1 <= x <= 1000
  double texture_correlation_time_s = 3;  // the texture's correlation falls to e^{-1/2} in this time, 0.1 <= x <= 1000
  ClutterDoppler doppler = ClutterDoppler::kPrescribed;
  double doppler_mean_mps = 0;      // mean velocity of the clutter, positive = receding, |x| <= 20
  double doppler_spread_mps = 0.5;  // standard deviation of its velocity, 0 <= x <= 20
  double hh_velocity_factor = 1.5;  // mean velocity by waves and wind of hh, hv, vh relative to vv, 0 <= x <= 5
  std::optional<double> sea_state;  // Douglas, 0 <= x <= 6; default: from the significant wave height
};

enum class Compression { kInverse, kMatched };
enum class Taper { kNone, kHann, kHamming, kTaylor };

struct MapSpec {
  // full width, centred on the target's reference point, > 0; limited to the unambiguous window
  double range_span_m = 192;
  double velocity_span_mps = 9.375;  // full width centred on zero, > 0
  double range_oversampling = 1;     // cells per range resolution c/(2 B_s), 1 <= x <= 16
  double velocity_oversampling = 1;  // cells per velocity resolution lambda/(2 N T_r), 1 <= x <= 16
  Compression compression = Compression::kInverse;
  Taper range_taper = Taper::kHann;
  Taper velocity_taper = Taper::kNone;
  bool clean = false;  // restore the points found by CLEAN without the pedestal of the hop code
};

}  // namespace seaglint

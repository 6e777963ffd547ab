// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The `radar`, `view`, `clutter` and `map` sections of a scenario, in the units of their keys. Defaults are the paper's
// radar; the inequality beside a field is checked by the reader (sim/scenario/fields.cpp).

#include <string>
#include <vector>

namespace seaglint {

enum class HopCode { kRandom, kBalanced, kStepped };
enum class Polarisation { kHh, kHv, kVh, kVv };  // first letter received, second transmitted

struct RadarSpec {
  double carrier_ghz = 16;       // lowest carrier, 0.1 <= x <= 300
  int hop_count = 8;             // number of carriers M, 1 <= x <= 1024
  double hop_step_mhz = 25;      // carrier spacing, > 0
  HopCode hop_code = HopCode::kRandom;  // random (independent, as in the paper), balanced, stepped
  double bandwidth_mhz = 25;     // LFM bandwidth B, 0.001 <= x <= 10000
  double pulse_width_us = 36;    // 0.001 <= x <= 1e6, shorter than pri_us
  double sampling_mhz = 50;      // complex sampling of the time-domain echo, >= bandwidth_mhz
  double pri_us = 250;           // 0.01 <= x <= 1e7
  int pulses = 256;              // of one coherent interval, 1 <= x <= 65536
  Polarisation polarisation = Polarisation::kVv;
  bool intra_pulse_motion = false;  // the f/mu term of Doppler inside the pulse, in echo and map alike; only with points as targets
};

using Sweep = std::vector<double>;  // a number, a list, or from:to:step in the file

struct ViewSpec {
  Sweep azimuth_deg{0};    // direction to the radar in the target frame, -360 <= x <= 360
  Sweep elevation_deg{2};  // of the radar seen from the target, -90 <= x <= 90
};

enum class ScrDefinition { kPerPulse, kPeakCell, kExtent };

struct ClutterSpec {
  double scr_db = 20;  // signal-to-clutter ratio, -60 <= x <= 200
  ScrDefinition scr_definition = ScrDefinition::kPerPulse;
  bool enabled = true;
  double noise_to_clutter_db = -30;  // receiver noise relative to clutter, -200 <= x <= 60
  double texture_shape = 2;          // shape of the K distribution's gamma texture, 0.1 <= x <= 1000
  double doppler_mean_mps = 0;       // mean velocity of the clutter, positive = receding, |x| <= 20
  double doppler_spread_mps = 0.5;   // standard deviation of its velocity, 0 <= x <= 20
};

enum class Compression { kInverse, kMatched };
enum class Taper { kNone, kHann, kHamming, kTaylor };

struct MapSpec {
  double range_span_m = 192;        // full width, centred on the target's reference point, > 0; never beyond the unambiguous window
  double velocity_span_mps = 9.375;  // full width centred on zero, > 0
  double range_oversampling = 1;    // cells per range resolution c/(2 B_s), 1 <= x <= 16
  double velocity_oversampling = 1;  // cells per velocity resolution lambda/(2 N T_r), 1 <= x <= 16
  Compression compression = Compression::kInverse;
  Taper range_taper = Taper::kHann;
  Taper velocity_taper = Taper::kNone;
};

}  // namespace seaglint

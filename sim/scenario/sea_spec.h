// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The `sea` section of a scenario, and one state picked from its sweeps.

#include "sim/scenario/radar_spec.h"

namespace seaglint {

struct SeaSpec {
  Sweep significant_wave_height_m{1};  // 0 <= x <= 30
  Sweep peak_period_s{8};              // 0.5 <= x <= 40; empty when dnv_wind_sea
  bool dnv_wind_sea = false;           // `peak_period_s: dnv_wind_sea`: Tp = 3.96 sqrt(Hs)
  Sweep gamma{3.3};                    // peak enhancement, 1 <= x <= 20
  Sweep propagation_deg{120};          // direction the waves travel towards, in the target frame, -360 <= x <= 360
  int order = 2;                       // 1 or 2
  int components = 512;                // 1 <= x <= 100000
  double cutoff_rad_s = 0;             // highest linear component; 0 = max(8, 4 wp); 0 <= x <= 100
  double second_order_cutoff_rad_s = 0;  // highest component in the quadratic sums; 0 = sqrt(2 g / Hs); 0 <= x <= 1000
};

enum class SeaSurface { kSeaWater, kConductor };
enum class SeaRoughness { kMillerBrownVegh, kAment, kNone };
enum class SeaPaths { kAll, kDirect, kMultipath };

// The `sea_reflection` section: the mean sea surface as a mirror between radar and target (sim/scattering/README.md, "Sea reflection"). The loss by
// waves follows the significant wave height of the sea state.
struct SeaReflectionSpec {
  bool enabled = false;
  SeaSurface surface = SeaSurface::kSeaWater;
  double temperature_c = 20;  // -2 <= x <= 29
  double salinity_psu = 35;   // 0 <= x <= 40
  SeaRoughness roughness = SeaRoughness::kMillerBrownVegh;
  SeaPaths paths = SeaPaths::kAll;  // direct: without those by way of the sea; multipath: those alone
};

// One sea state: a SeaSpec with one value of each sweep.
struct SeaState {
  double significant_wave_height_m = 1;
  double peak_period_s = 8;
  double gamma = 3.3;
  double propagation_rad = 0;
  int order = 2;
  int components = 512;
  double cutoff_rad_s = 8;
  double second_order_cutoff_rad_s = 4.43;
};

}  // namespace seaglint

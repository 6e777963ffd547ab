// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The `sea` section of a scenario, and one state picked from its sweeps.

#include <memory>
#include <optional>
#include <string>

#include "sim/core/numbers/dispersion.h"
#include "sim/scenario/files/spectrum_table.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

enum class SpectrumKind { kJonswap, kBretschneider, kTable };

// kExact: the density integrates to Hs^2/16. kDnv: the factor 1 - 0.287 ln gamma of DNV-RP-C205, whose energy error is
// +0.24 % at gamma 3.3, -1.8 % at 7.
enum class SpectrumNormalisation { kExact, kDnv };

// `peak_period_s: dnv_wind_sea` is Tp = 3.96 sqrt(Hs); wind_and_fetch follows from the section `wind`.
enum class PeakPeriod { kGiven, kDnvWindSea, kWindAndFetch };
enum class PeakEnhancement { kGiven, kDnvRule };  // `gamma: dnv_rule`: from Tp / sqrt(Hs)
enum class WaveHeight { kGiven, kFromTable };     // `significant_wave_height_m: from_table`: energy of the table
enum class WaveAmplitude { kFixed, kRandom };
enum class Spreading { kNone, kCos2s, kMitsuyasu, kWrappedNormal };

// Directional spreading (sim/sea/README.md, "Directions").
struct SpreadingSpec {
  Spreading kind = Spreading::kNone;
  double s = 10;          // of cos2s; of mitsuyasu at the peak; 0 < x <= 200
  double width_deg = 30;  // standard deviation of wrapped_normal, 0 < x <= 180
};

// U and F of Hasselmann et al. (1973), for `peak_period_s: wind_and_fetch`.
struct WindSpec {
  double speed_mps = 10;  // 10 m above the water, 1 <= x <= 60
  double fetch_km = 100;  // 0.1 <= x <= 5000
};

// Swell: a second wave system.
struct SwellSpec {
  double significant_wave_height_m = 0;  // 0 = none, or 1e-6 <= x <= 30
  double peak_period_s = 12;             // 0.5 <= x <= 40
  double gamma = 5;                      // 1 <= x <= 20
  // In the place of peak_period_s: mean periods as of the sea, 0.3 <= x <= 40
  std::optional<double> energy_period_s, zero_crossing_period_s;
  double propagation_deg = 120;           // as of the sea, -360 <= x <= 360
  std::optional<double> coming_from_deg;  // in its place, as of the sea
  int components = 128;                   // 1 <= x <= 100000
  SpreadingSpec spreading;
};

struct SeaSpec {
  Sweep significant_wave_height_m{1};  // of the wind sea, 0 or 1e-6 <= x <= 30; empty with from_table
  WaveHeight height_rule = WaveHeight::kGiven;
  Sweep peak_period_s{8};  // 0.5 <= x <= 40; empty when a rule gives it
  PeakPeriod period_rule = PeakPeriod::kGiven;
  // In the place of peak_period_s: the mean periods Te = 2 pi m_-1/m_0 and Tz = 2 pi sqrt(m_0/m_2) of the whole
  // spectrum without a cut-off, 0.3 <= x <= 40; empty: not given. The peak period that they give is within its bounds.
  Sweep energy_period_s, zero_crossing_period_s;
  // In the place of peak_period_s: Sp = 2 pi Hs / (g Tp^2) (DNV-RP-C205, 3.5.4.1), with the deep-water wavelength at
  // any depth, 1e-4 <= x <= 0.14; empty: not given.
  Sweep steepness;
  // In the place of wave height and period: file of pairs of them, of which each sea realisation has one.
  std::string scatter_diagram;
  WindSpec wind;
  SpectrumKind spectrum = SpectrumKind::kJonswap;
  std::string table;       // file of spectrum: table, in the scenario's folder or the working directory
  std::string table_time;  // of a file of several spectra: "2018-01-01 00:40"
  std::shared_ptr<const SpectrumTable> table_values;  // contents of that file
  Sweep gamma{3.3};                                   // peak enhancement, 1 <= x <= 20; empty when a rule gives it
  PeakEnhancement gamma_rule = PeakEnhancement::kGiven;
  SpectrumNormalisation normalisation = SpectrumNormalisation::kExact;
  Sweep propagation_deg{120};  // direction the waves travel towards, in the target frame, -360 <= x <= 360
  Sweep coming_from_deg;       // in its place: direction the waves come from, likewise; empty: not given
  SpreadingSpec spreading;
  SwellSpec swell;
  std::optional<double> depth_m;  // 0.5 <= x <= 12000; deep water without it
  WaveAmplitude amplitude = WaveAmplitude::kFixed;
  int order = 2;                         // 1 or 2
  int components = 512;                  // of the wind sea, 1 <= x <= 100000
  double cutoff_rad_s = 0;               // highest linear component; 0 = max(8, 4 wp); 0 <= x <= 100
  double second_order_cutoff_rad_s = 0;  // highest component in the quadratic sums; 0 = where k Hs = 2; 0 <= x <= 1000
};

enum class SeaSurface { kSeaWater, kConductor };
enum class SeaRoughness { kMillerBrownVegh, kAment, kNone };
enum class SeaPaths { kAll, kDirect, kMultipath };

// The `sea_reflection` section: specular reflection by the mean sea surface between radar and target
// (sim/scattering/solver/README.md, "Sea reflection"). The roughness factor follows the significant wave height of
// the sea state.
struct SeaReflectionSpec {
  bool enabled = false;
  SeaSurface surface = SeaSurface::kSeaWater;
  double temperature_c = 20;  // -2 <= x <= 29
  double salinity_psu = 35;   // 0 <= x <= 40
  SeaRoughness roughness = SeaRoughness::kMillerBrownVegh;
  SeaPaths paths = SeaPaths::kAll;  // kDirect: without paths via the sea surface; kMultipath: only those
};

// One wave system of a state: wind sea or swell.
struct WaveSystemState {
  double significant_wave_height_m = 0;
  double peak_period_s = 8;
  double gamma = 3.3;
  double propagation_rad = 0;
  SpreadingSpec spreading;
  int components = 128;
};

// One sea state: a SeaSpec with one value of each sweep. The first four fields describe the wind sea.
struct SeaState {
  double significant_wave_height_m = 1;
  double peak_period_s = 8;
  double gamma = 3.3;
  double propagation_rad = 0;
  double propagation_deg = 0;  // as given in the scenario, for records; computations use propagation_rad
  int order = 2;
  int components = 512;
  double cutoff_rad_s = 8;
  double second_order_cutoff_rad_s = 4.43;
  SpreadingSpec spreading;
  SpectrumNormalisation normalisation = SpectrumNormalisation::kExact;
  std::shared_ptr<const SpectrumTable> table;  // replaces JONSWAP, scaled to the significant wave height
  WaveSystemState swell;                       // height 0: none
  double depth_m = kDeepWater;
  WaveAmplitude amplitude = WaveAmplitude::kFixed;
};

}  // namespace seaglint

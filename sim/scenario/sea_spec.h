// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The `sea` section of a scenario, and one state picked from its sweeps.

#include <memory>
#include <optional>
#include <string>

#include "sim/core/numbers/dispersion.h"
#include "sim/scenario/files/tables.h"
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
  double s = 10;
  double width_deg = 30;

  bool operator==(const SpreadingSpec&) const = default;
};

// U and F of Hasselmann et al. (1973), for `peak_period_s: wind_and_fetch`.
struct WindSpec {
  double speed_mps = 10;
  double fetch_km = 100;

  bool operator==(const WindSpec&) const = default;
};

// Swell: a second wave system.
struct SwellSpec {
  double significant_wave_height_m = 0;
  double peak_period_s = 12;
  double gamma = 5;
  std::optional<double> energy_period_s, zero_crossing_period_s;
  double propagation_deg = 120;
  std::optional<double> coming_from_deg;
  int components = 128;
  SpreadingSpec spreading;

  bool operator==(const SwellSpec&) const = default;
};

struct SeaSpec {
  Sweep significant_wave_height_m{1};  // empty with from_table
  WaveHeight height_rule = WaveHeight::kGiven;
  Sweep peak_period_s{8};  // empty when a rule or another key gives it
  PeakPeriod period_rule = PeakPeriod::kGiven;
  Sweep energy_period_s, zero_crossing_period_s;  // empty: not given
  Sweep steepness;                                // empty: not given
  std::string scatter_diagram;
  WindSpec wind;
  SpectrumKind spectrum = SpectrumKind::kJonswap;
  std::string table;
  std::string table_time;
  FileContents<SpectrumTable> table_values;  // contents of that file
  Sweep gamma{3.3};                          // empty when a rule gives it
  PeakEnhancement gamma_rule = PeakEnhancement::kGiven;
  SpectrumNormalisation normalisation = SpectrumNormalisation::kExact;
  Sweep propagation_deg{120};
  Sweep coming_from_deg;  // empty: not given
  SpreadingSpec spreading;
  SwellSpec swell;
  std::optional<double> depth_m;
  WaveAmplitude amplitude = WaveAmplitude::kFixed;
  int order = 2;
  int components = 512;
  double cutoff_rad_s = 0;
  double second_order_cutoff_rad_s = 0;

  bool operator==(const SeaSpec&) const = default;
};

enum class SeaSurface { kSeaWater, kConductor };
enum class SeaRoughness { kMillerBrownVegh, kAment, kNone };
enum class SeaPaths { kAll, kDirect, kMultipath };
enum class SurfaceProfileKind { kMean, kWaves };

// The `sea_reflection` section: specular reflection by the mean sea surface between radar and target, or propagation
// over its waves (sim/scattering/solver/README.md, "Sea reflection"). The roughness factor follows the significant wave
// height of the sea state.
struct SeaReflectionSpec {
  bool enabled = false;
  SeaSurface surface = SeaSurface::kSeaWater;
  double temperature_c = 20;
  double salinity_psu = 35;
  SeaRoughness roughness = SeaRoughness::kMillerBrownVegh;
  SeaPaths paths = SeaPaths::kAll;
  SurfaceProfileKind surface_profile = SurfaceProfileKind::kMean;

  bool operator==(const SeaReflectionSpec&) const = default;
};

// One wave system of a state: wind sea or swell.
struct WaveSystemState {
  double significant_wave_height_m = 0;
  double peak_period_s = 8;
  double gamma = 3.3;
  double propagation_rad = 0;
  SpreadingSpec spreading;
  int components = 128;

  bool operator==(const WaveSystemState&) const = default;
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

  bool operator==(const SeaState&) const = default;
};

}  // namespace seaglint

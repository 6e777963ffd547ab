// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Statistics of one realisation and of many, and distributions of crest heights.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/sea_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// In flat water all fields but the cut-offs are zero.
struct SeaSummary {
  double significant_wave_height_m = 0;  // 4 sqrt(sum a^2/2)
  double mean_period_s = 0;              // T1 = 2 pi m0/m1 of the components
  double cutoff_rad_s = 0;
  double second_order_cutoff_rad_s = 0;     // infinite in flat water
  double energy_fraction_above_cutoff = 0;  // of the wind-sea spectrum; it is added to the components below
  double slope_variance = 0;                // of the linear part; grows with the logarithm of the cut-off
  double slope_variance_next_octave = 0;    // contribution of the spectrum between the cut-off and twice the cut-off
  bool long_crested = true;                 // all components have one direction
  double direction_r1 = 0;                  // length of the energy-weighted mean direction vector
  double skewness = 0;                      // of the elevation to leading order; 0 at order 1
  double steepness = 0;                     // S1 = 2 pi Hs / (g T1^2)
  double ursell = 0;                        // Ur = Hs / (k1^2 h^3), k1 the wavenumber of T1; 0 in deep water
};
SeaSummary summarise(const SeaState& state, const WaveField& field);

// Prescribed density: sum of wind sea and swell, m^2 s/rad.
double prescribed_density(const SeaState& state, double omega);

// Crest heights of an elevation series at uniform times: the maximum between each zero up-crossing and the next
// down-crossing, of the parabola through the highest sample and its neighbours (at most 0.15 % low for twelve samples
// per period).
std::vector<double> crest_heights(std::span<const double> elevation);

// Probability that a crest exceeds `height` in narrow-band linear waves (Rayleigh; Longuet-Higgins 1952).
double rayleigh_exceedance(double height, double significant_wave_height);

// Weibull distribution of crest heights, fitted by Forristall (2000, J. Phys. Oceanogr. 30, 1931) to second-order
// simulations: P(crest > x) = exp(-(x / (alpha Hs))^beta).
struct ForristallCrests {
  double scale = 0;  // alpha Hs, m
  double beta = 2;

  double exceedance(double height) const;
  double height(double probability) const;  // m, exceeded with this probability
};
// For long-crested or directionally spread waves; deep water: ursell = 0.
ForristallCrests forristall_crests(double significant_wave_height, double steepness, double ursell, bool long_crested);

// Spectrum, moments and crest heights over many realisations.
struct SeaEnsemble {
  int realisations = 0;
  double significant_wave_height_m = 0;  // 4 standard deviations of the elevation
  double skewness = 0;
  double kurtosis = 0;  // 3 for a Gaussian sea
  double zero_crossing_period_s = 0;
  std::vector<double> crests;           // m, ascending
  std::vector<double> omega;            // rad/s
  std::vector<double> prescribed;       // density of the prescribed spectrum, m^2 s/rad
  std::vector<double> realised;         // of the elevation series, averaged over bands and realisations
  std::vector<double> realised_linear;  // of the linear part alone
};

// Elevation series of realisations 0 to `realisations` - 1 at one point.
struct EnsembleRequest {
  const SeaState& state;
  std::size_t state_index = 0;  // among the sea states of the scenario
  std::uint64_t seed = 1;
  int realisations = 20;
  double duration_s = 600, step_s = 0.1;  // of each series; a step is at most a twentieth of the peak period
  int threads = 1;                        // without influence on the result
  const StopFlag* stop = nullptr;
};

// Throws InputError for a duration too short for a spectrum, Interrupted when *stop becomes true.
SeaEnsemble make_ensemble(const EnsembleRequest& request);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Statistics over many realisations of a sea state: spectrum, moments, crest heights.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/sea/statistics.h"

namespace seaglint {

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

// Realisations 0 to count - 1 of a scenario's sea state `state_index`, elevation series of `duration_s` at one point.
// The result does not depend on the number of threads.
SeaEnsemble make_ensemble(const SeaState& state, std::size_t state_index, std::uint64_t seed, int count,
                          double duration_s, double step_s, int threads, const StopFlag& stop);

}  // namespace seaglint

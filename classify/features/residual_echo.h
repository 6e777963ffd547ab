// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Residual echo of CLEAN: components are fitted to it and subtracted with their exact phase history, so that the
// residual is exact up to rounding for any hop code, holes, tapers and motion. Its floor and its level around each
// component separate scattering centres from noise, clutter and pedestals.

#include <cstddef>
#include <span>
#include <vector>

#include "radar/rvmap/rv_map.h"
#include "radar/waveform/pulse_train.h"

namespace seaglint {

// A point of complex amplitude a, phase reference the band's centre at the first pulse (as in RvMap).
struct CleanComponent {
  double range_m = 0;
  double velocity_mps = 0;
  Complex amplitude_m;
};

class ResidualEcho {
 public:
  ResidualEcho(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& spec, bool intra_pulse_motion);

  RvMap map(const StopFlag* stop = nullptr) const;           // exact map of the residual (form_rv_map())
  Complex value(double range_m, double velocity_mps) const;  // value of that map at one point

  // Nearest maximum of the residual's |RV|, at most reach_r and reach_v from (range_m, velocity_mps); its amplitude is
  // the map's value there.
  CleanComponent fit(double range_m, double velocity_mps, double reach_r, double reach_v) const;

  void subtract(const CleanComponent& point);

 private:
  // Contribution of one pulse to RV near a point, as moments over baseband frequency: M_p = sum_b F Y e^{j phase} (4 pi
  // f_b / c)^p.
  struct PulseMoments {
    Complex m0, m1, m2, m3;
  };
  std::vector<PulseMoments> moments(double range_m, double velocity_mps) const;

  const PulseTrain& train_;
  const MapSpec& spec_;
  bool intra_pulse_motion_;
  std::vector<Complex> echo_;    // [pulse][frequency]
  std::vector<Complex> weight_;  // w_n u_k filter_b, [pulse][frequency]: RV = sum of weight echo e^{j phase}
};

// Shorter rows or columns have no level of their own: the quantile could be a target's cell.
inline constexpr std::size_t kMinCells = 8;

// Mean power of the residual at every cell, [velocity][range], estimated so that a few centres do not raise it. The
// three causes differ in shape: noise is flat, clutter a ridge along range at its Doppler, pedestals lie along velocity
// at their range. Their powers add: the level of a cell is the largest of the map's, its column's and its row's level
// and of column + row - map; each from a quantile of |RV|^2, scaled to the mean of an exponential distribution.
std::vector<double> residual_floor(const RvMap& residual);

// Threshold relative to the mean power that noise exceeds in 1 % of maps: exponential |RV|^2 in `cells` independent
// cells.
double threshold_factor(double cells);

// Sizes of a resolution cell, of a point's main lobe and of the map's cells.
struct CellSizes {
  double range_m = 1;                                        // c / (2 B_s)
  double velocity_mps = 1;                                   // lambda / (2 N T_r)
  double range_oversampling = 1, velocity_oversampling = 1;  // cells of the map per resolution cell
  // power of a point of amplitude 1, summed over the resolution cells of each axis
  double lobe_ranges = 1, lobe_velocities = 1;
};

// Separates scattering centres from clutter peaks among the CLEAN components, by comparing each with the residual power
// around it and with the clutter of all ranges. For each of `points`: true if its power is at least `min_power` and at
// least `factor` times its level. The level is residual_floor at its cell where accepted points dominate its
// surroundings, else the larger of that and of the clutter ridge's level in 11 velocities x 11 ranges around it times a
// margin for textured clutter; but the ridge never counts more than its level at the 90 % quantile of all ranges
// (README.md). The power of a rejected point is returned to the surroundings of the others.
std::vector<bool> exceeds_local_level(std::span<const CleanComponent> points, const RvMap& residual,
                                      const std::vector<double>& floor, double factor, double min_power,
                                      const CellSizes& cells);

// Ratio of thresholds of equal false-alarm probability in K-distributed clutter of this shape and in exponential
// clutter of the same mean, whose threshold is `factor` times the mean; accurate to 1e-6 for 0.5 <= shape <= 100, 5 <=
// factor <= 30.
double texture_threshold_margin(double shape, double factor);

}  // namespace seaglint

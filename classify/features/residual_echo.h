// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Residual echo of CLEAN: components are fitted to it and subtracted with their exact phase history, so that the
// residual is exact up to rounding for any hop code, holes, tapers and motion.

#include <span>
#include <vector>

#include "radar/rvmap/map_weights.h"
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

  RvMap map() const;                                         // exact map of the residual
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

}  // namespace seaglint

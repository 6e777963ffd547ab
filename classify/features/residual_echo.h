// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The echo that CLEAN works on: points are fitted to it and taken out of it at their exact phase history, so that what
// remains is known to rounding whatever the code, holes, tapers and motion.

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

  RvMap map() const;                                         // exact map of what remains
  Complex value(double range_m, double velocity_mps) const;  // its value at one point

  // Climbs from (range_m, velocity_mps) to the nearest maximum of the residual's |RV|, at most reach_r and reach_v
  // away; the amplitude is the map's value there.
  CleanComponent fit(double range_m, double velocity_mps, double reach_r, double reach_v) const;

  void subtract(const CleanComponent& point);

 private:
  // What one pulse adds to RV near a point, as moments of its baseband frequency: M_p = sum_b F Y e^{j phase} (4 pi f_b
  // / c)^p.
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

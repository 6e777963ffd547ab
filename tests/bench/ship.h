// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The ship, the look directions and the interval that the benchmarks of the solver have in common.

#include <ctime>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/scatterer/prepare_target.h"
#include "sim/scattering/solver/solve.h"

namespace seaglint {

// Look direction of the radar, elevation 2 deg.
inline Vec3 direction(double azimuth_deg) { return direction_to_radar(radians(azimuth_deg), radians(2)); }

inline const Scatterer& ship() {
  static const PreparedTarget target = [] {
    TargetSource source;
    source.mesh = SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb";
    return prepare_target(load_target_mesh(source), {});
  }();
  return *target.scatterer;
}

// Extent of the target in the projection plane.
inline Box window_of(const Scatterer& scatterer, const RadarBasis& basis) {
  Box window{Vec2::Constant(1e9), Vec2::Constant(-1e9)};
  for (const Facet& facet : scatterer.facets()) {
    for (const Vec3& x : facet.corner) {
      const Vec2 p(x.dot(basis.h), x.dot(basis.v));
      window = {window.lower.cwiseMin(p), window.upper.cwiseMax(p)};
    }
  }
  return window;
}

// The paper's interval: 256 pulses of 25 MHz, 320 frequencies.
inline IntervalSampling paper_interval() {
  IntervalSampling sampling;
  sampling.step_hz = 0.625e6;
  sampling.first_hz = 16e9 - 12.5e6 + 0.5 * sampling.step_hz;
  sampling.count = 320;
  sampling.frequencies_per_pulse = 40;
  for (int n = 0; n < 256; ++n) {
    sampling.pulse_first.push_back(40 * (n * 5 % 8));
    sampling.pulse_time_s.push_back(0.5 + 250e-6 * n);
  }
  return sampling;
}

// Roll with the given rate, rad/s.
inline Trajectory rolling(double rate, const Vec3& centre) {
  std::vector<MotionSample> samples(101);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].angles.x() = rate * 0.01 * static_cast<double>(i);
    samples[i].angle_rates.x() = rate;
  }
  return Trajectory(0, 0.01, samples, Vec3::Zero(), centre);
}

// Processor time of all threads, s.
template <typename Work>
double processor_seconds(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace seaglint

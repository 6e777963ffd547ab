// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A float a metre across: it tilts with the water at its own place.

#include <array>
#include <vector>

#include "sim/core/random.h"
#include "sim/geometry/triangle_mesh.h"
#include "sim/motion/oscillator.h"
#include "sim/motion/trajectory.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// The zero fields of the spec filled in (README.md, "Floats").
struct FloatParticulars {
  double diameter = 1;  // of the waterplane, m
  double draught = 0;   // m, 0 = shallow
  Oscillator roll, pitch, heave;
};

// Throws InputError when the mesh has no size to derive from.
FloatParticulars float_particulars(const MotionSpec& spec, const Bounds& bounds);

// Mean slope of a wave over a disc of radius R, weighted as its moment is: 8 J2(kR) / (kR)^2, 1 for long waves.
double disc_slope_filter(double wavenumber, double radius);

// The slope a float follows: the water's up to breaking, s / (1 + (s/0.4)^4)^(1/4), in the slope's own direction.
inline constexpr double kBreakingSlope = 0.4;
Vec2 limited_slope(const Vec2& slope);

// A slow random rotation: a sum of kYawHarmonics cosines that share the variance of the rate equally, with the
// frequencies of an Ornstein-Uhlenbeck process of correlation time kYawCorrelationTime; smooth, and the same for any
// time step. Without a spring the heading at t = 0 is uniform; with one (period > 0) each harmonic passes through the
// spring's oscillator and the mean heading is 0. A rate of 0 leaves the float at heading 0.
inline constexpr int kYawHarmonics = 64;
inline constexpr double kYawCorrelationTime = 10;  // s

class RandomYaw {
 public:
  // rate: standard deviation, rad/s.
  RandomYaw(double rate, double period, double damping, std::uint64_t seed, std::uint64_t index);

  OscillatorState at(double t) const;

 private:
  double heading_ = 0;
  std::vector<double> omega_, phase_, amplitude_;  // amplitude_ of the rate
};

// Samples at t = 0, step, ..., at least up to duration_s, of a float whose centre of flotation rests at (x, y).
std::vector<MotionSample> simulate_float(const FloatParticulars& body, const MotionSpec& spec, const WaveField& sea,
                                         double x, double y, double duration_s, std::uint64_t seed,
                                         std::uint64_t index);

}  // namespace seaglint

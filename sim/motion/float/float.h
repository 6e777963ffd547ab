// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Motion of a small float (about 1 m): it responds to the local water surface and rotates slowly at random about the
// vertical.

#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Sum of kYawHarmonics cosines of equal variance, whose rate has the spectrum of an Ornstein-Uhlenbeck process of
// correlation time kYawCorrelationTime; smooth and independent of the time step. Without a spring (period = 0) the
// heading at t = 0 is uniform; with one each harmonic is filtered by the oscillator of the spring and the mean heading
// is 0. rate = 0: heading 0.
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

// Parameters of a float, the zero fields of the spec filled in (sim/motion/float/README.md).
struct FloatParticulars {
  double diameter = 1;  // of the waterplane, m
  double draught = 0;   // m, 0 = shallow
  double effective_slope = 1;
  Oscillator roll, pitch, heave;
};

// Throws InputError for a mesh without extent.
FloatParticulars float_particulars(const MotionSpec& spec, const Bounds& bounds);

// Moment-weighted mean of a wave slope over a disc of radius R, per slope at its centre: 8 J2(kR) / (kR)^2, 1 for long
// waves.
double disc_slope_filter(double wavenumber, double radius);

// Slope that forces a float: s / (1 + (s/0.4)^4)^(1/4), the water slope s limited smoothly at breaking, direction
// unchanged.
inline constexpr double kBreakingSlope = 0.4;
Vec2 soft_limited_slope(const Vec2& slope);

// A float in the waves.
struct FloatRequest {
  const FloatParticulars& body;
  const MotionSpec& spec;
  const WaveField& sea;
  Vec2 place;            // of the centre of flotation at rest, m
  double speed_mps = 0;  // at which the place moves through the waves, along x: place + t speed of the wave field
  std::uint64_t seed = 1, index = 0;  // of the random yaw
};

// Samples at t = 0, step, ..., at least up to duration_s, relative to the place.
std::vector<MotionSample> simulate_float(const FloatRequest& request, double duration_s);

// The same of a line of floats of one MotionSpec with translations, whose neighbours are joined by ropes. After every
// step the floats are drawn together to the ropes' length (hold_places()), and rates of samples are those with which no
// taut rope lengthens (hold_velocities()).
std::vector<std::vector<MotionSample>> simulate_tethered_floats(std::span<const FloatRequest> line, double rope_m,
                                                                double duration_s);

}  // namespace seaglint

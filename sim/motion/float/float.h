// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Motion of a small float (about 1 m): it responds to the local water surface.

#include <cstdint>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/motion/kinematics/oscillator.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Parameters of a float, the zero fields of the spec filled in (sim/motion/float/README.md).
struct FloatParticulars {
  double diameter = 1;  // of the waterplane, m
  double draught = 0;   // m, 0 = shallow
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

// Samples at t = 0, step, ..., at least up to duration_s, of a float whose centre of flotation rests at (x, y).
std::vector<MotionSample> simulate_float(const FloatParticulars& body, const MotionSpec& spec, const WaveField& sea,
                                         double x, double y, double duration_s, std::uint64_t seed,
                                         std::uint64_t index);

}  // namespace seaglint

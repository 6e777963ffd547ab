// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Motion of a body in a wave field.

#include <cstdint>

#include "sim/motion/body.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Where the origin of a body's mesh rests when its place on the water is (x, y): at the waterline for a ship and a
// fixed body, spec.origin_above_waterline_m higher for a float, whose mesh has its origin in the middle.
Vec3 rest_position(const MotionSpec& spec, double x, double y);

// The motion of one body resting with its origin at rest_position (target frame), from t = 0 to duration_s or the end
// of the step that holds it. The random yaw of a float uses stream kFloatYaw of (seed, index). For `waves: independent`
// the caller gives each body a sea of its own.
Trajectory simulate_motion(const Body& body, const Vec3& rest_position, const WaveField& sea, double duration_s,
                           std::uint64_t seed, std::uint64_t index);

}  // namespace seaglint

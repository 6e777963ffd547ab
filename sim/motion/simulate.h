// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Motion of a body in a wave field.

#include <cstdint>

#include "sim/motion/body.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Rest position of the mesh origin of a body at (x, y) on the water: at the waterline for a ship and a fixed body,
// spec.origin_above_waterline_m above it for a float, whose mesh has its origin in its middle.
Vec3 rest_position(const MotionSpec& spec, double x, double y);

// Motion of one body with its origin at rest_position (target frame), from t = 0 to the end of the step that contains
// duration_s. The random yaw of a float uses stream kFloatYaw of (seed, index). For `waves: independent` the caller
// passes a separate sea per body.
Trajectory simulate_motion(const Body& body, const Vec3& rest_position, const WaveField& sea, double duration_s,
                           std::uint64_t seed, std::uint64_t index);

}  // namespace seaglint

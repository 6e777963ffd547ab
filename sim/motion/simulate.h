// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Motion of a ship or a float in a wave field.

#include <cstdint>

#include "sim/geometry/triangle_mesh.h"
#include "sim/motion/trajectory.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// The motion of one body resting with its origin at rest_position (target frame), from t = 0 to duration_s. `bounds` is the box of its
// mesh (zero fields of the spec are derived from it). The random yaw of a float uses stream kFloatYaw of (seed, index).
// Throws InputError when the spec contradicts itself.
Trajectory simulate_motion(const MotionSpec& spec, const Bounds& bounds, const Vec3& rest_position, const WaveField& sea,
                           double duration_s, std::uint64_t seed, std::uint64_t index);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A radar that moves past the target: in the far field nothing but the direction to it counts, so that turning the
// scene about the reference point is the same.

#include "sim/core/linear.h"
#include "sim/motion/trajectory.h"
#include "sim/scattering/frequency_response.h"

namespace seaglint {

// The rotation, without any about the line of sight, that brings the direction to the radar at time_s back to r_hat.
Mat3 turn_of_scene(const IntervalSampling& sampling, const Vec3& r_hat, double time_s);

// A body's pose in the turned scene.
Pose seen_pose(const Trajectory& trajectory, const IntervalSampling& sampling, const Vec3& r_hat, double time_s);

}  // namespace seaglint

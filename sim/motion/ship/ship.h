// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Ship motion in waves by strip theory: coupled heave and pitch, coupled sway, roll and yaw; optional nonlinear roll
// damping.

#include <vector>

#include "sim/motion/kinematics/trajectory.h"
#include "sim/motion/ship/ship_particulars.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Samples at t = 0, step, ..., at least up to duration_s, of a ship whose origin is at (x, y) at t = 0 and moves on at
// its speed, relative to that mean motion.
std::vector<MotionSample> simulate_ship(const ShipParticulars& ship, const MotionSpec& spec, const WaveField& sea,
                                        double x, double y, double duration_s);

}  // namespace seaglint

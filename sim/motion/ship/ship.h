// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A ship in waves: heave with pitch, and sway with roll and yaw, by strip theory; roll damping may be nonlinear.

#include <vector>

#include "sim/motion/kinematics/trajectory.h"
#include "sim/motion/ship/ship_particulars.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Samples at t = 0, step, ..., at least up to duration_s, of a ship whose origin rests at (x, y) at t = 0 and goes on
// with its speed; the samples are relative to that mean way.
std::vector<MotionSample> simulate_ship(const ShipParticulars& ship, const MotionSpec& spec, const WaveField& sea,
                                        double x, double y, double duration_s);

}  // namespace seaglint

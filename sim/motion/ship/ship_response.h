// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Response amplitude operators of a ship.

#include "sim/core/numbers/linear.h"
#include "sim/motion/ship/ship_particulars.h"
#include "sim/motion/strip_theory/strip_theory.h"

namespace seaglint {

// Response amplitude operators, rad/m and m/m, in the time factor e^{j w_e t} of the encounter frequency; translations
// of the rotation centre. The phase reference is the elevation at the ship's origin.
struct MotionRao {
  Complex surge, sway, heave, roll, pitch, yaw;
};
MotionRao ship_rao(const ShipParticulars& ship, const ShipWave& wave);

}  // namespace seaglint

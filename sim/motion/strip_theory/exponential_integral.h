// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Exponential integral of a complex argument, for free-surface potentials.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// e^z E1(z), E1(z) = int_z^inf e^{-t}/t dt, cut along the negative real axis (on it: the value from above). For z != 0
// in the upper half plane, Im z >= 0; relative error below 1e-6.
Complex scaled_exponential_integral(Complex z);

}  // namespace seaglint

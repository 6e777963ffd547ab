// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Logarithm, exponential and hyperbolic tangent from +, -, *, / and scaling by powers of two only, which IEEE 754
// rounds identically everywhere; those of libm differ between versions and processors.

namespace seaglint {

double reproducible_log(double x);   // x > 0 and normal; relative error below 4e-16, absolute near 1
double reproducible_exp(double x);   // relative error below 4e-16; 0 below -700
double reproducible_tanh(double x);  // relative error below 1e-15

}  // namespace seaglint

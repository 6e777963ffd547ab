// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Gamma variates from normal ones, for the texture of K-distributed clutter.

namespace seaglint {

// Regularised incomplete gamma functions P(a, x) and Q = 1 - P, a > 0, x >= 0; relative error below 1e-12 for a <=
// 1000.
double gamma_p(double a, double x);
double gamma_q(double a, double x);

// Quantile Phi(normal) of the gamma distribution with mean 1 and the given shape (0.1 <= shape <= 1000); monotone in
// normal, so that correlated normal values give correlated texture. Relative error below 1e-9 for |normal| <= 6.
double gamma_texture(double shape, double normal);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/diffraction/fade_windows.h"

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/smooth_step.h"

namespace seaglint {

double beside_the_beam(const Vec3& k_hat, const Vec3& s) { return fading(k_hat.dot(s), {0, std::cos(kPi / 6)}); }

double before_the_beam(const Vec3& k_hat, const Vec3& s) { return before_the_beam(k_hat.dot(s)); }
double before_the_beam(double cosine) { return fading(cosine, {0.95, 0.999}); }

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/diffraction/fade_windows.h"

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/smooth_step.h"

namespace seaglint {

double fringe_forward_taper(const Vec3& k_hat, const Vec3& s) {
  return smooth_taper(k_hat.dot(s), {0, std::cos(kPi / 6)});
}

double diffraction_forward_taper(const Vec3& k_hat, const Vec3& s) { return diffraction_forward_taper(k_hat.dot(s)); }
double diffraction_forward_taper(double cosine) { return smooth_taper(cosine, {0.95, 0.999}); }

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/fade_windows.h"

#include <cmath>

#include "sim/core/numbers/smooth_step.h"

namespace seaglint {

double fringe_forward_taper(const Vec3& k_hat, const Vec3& s) {
  return smooth_taper(k_hat.dot(s), kFringeForwardWindow);
}

double diffraction_forward_taper(const Vec3& k_hat, const Vec3& s) {
  return smooth_taper(k_hat.dot(s), kDiffractionForwardWindow);
}

double grazing_taper(const Vec3& s, const Vec3& n) { return smooth_taper(std::abs(n.dot(s)), kGrazingWindow); }

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/strip_theory/lewis_form.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {

Complex LewisForm::point(double alpha) const {
  const Complex zeta = std::polar(1.0, alpha);
  return scale * (zeta + a1 / zeta + a3 / (zeta * zeta * zeta));
}

Complex LewisForm::derivative(double alpha) const {
  const Complex zeta = std::polar(1.0, alpha);
  return Complex(0, 1) * scale * (zeta - a1 / zeta - 3 * a3 / (zeta * zeta * zeta));
}

// Half of pi M^2 (1 - sum n a_n^2), the area within the image of a circle.
double LewisForm::area() const { return 0.5 * kPi * scale * scale * (1 - a1 * a1 - 3 * a3 * a3); }

// int z dA = int y z dz over both sides, by the midpoint rule (relative error below 1e-6).
double LewisForm::area_centre() const {
  constexpr int kPoints = 512;
  double moment = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double alpha = -0.5 * kPi * (i + 0.5) / kPoints;
    const Complex p = point(alpha);
    moment += 2 * p.real() * p.imag() * derivative(alpha).imag();
  }
  return moment * 0.5 * kPi / kPoints / area();
}

// A form is valid while its breadth does not decrease towards the waterline nor its depth towards the keel, and it does
// not cross the axes; for the area coefficient s: 3 pi/32 (2 - H) <= s <= pi/32 (H + 1/H + 10) with H the smaller of
// half-breadth/draught and its reciprocal (von Kerczek and Tuck 1969).
AreaRange lewis_area_range(double half_breadth_to_draught) {
  const double h = std::min(half_breadth_to_draught, 1 / half_breadth_to_draught);
  return {3 * kPi / 32 * (2 - h), kPi / 32 * (h + 1 / h + 10)};
}

// Breadth/2 = M (1 + a1 + a3) and draught = M (1 - a1 + a3) give a1 = (1 + a3) q, q = (H - 1)/(H + 1); the area is then
// quadratic in a3: with s = area/(breadth draught) and c = 3 + 4 s/pi + (1 - 4 s/pi) q^2,
// c a3^2 + 2 (c - 3) a3 + (c - 4) = 0, larger root.
LewisForm lewis_form(double breadth, double draught, double area) {
  const double h = 0.5 * breadth / draught;
  const double q = (h - 1) / (h + 1);
  const AreaRange range = lewis_area_range(h);
  const double s = std::clamp(area / (breadth * draught), range.least, range.largest);
  const double c = 3 + 4 * s / kPi + (1 - 4 * s / kPi) * q * q;
  LewisForm form;
  // At the maximum area 9 - 2 c is 0 to rounding, of either sign.
  form.a3 = (3 - c + std::sqrt(std::max(0.0, 9 - 2 * c))) / c;
  form.a1 = q * (1 + form.a3);
  form.scale = 0.5 * breadth / (1 + form.a1 + form.a3);
  return form;
}

}  // namespace seaglint

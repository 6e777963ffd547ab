// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Lewis form: a ship section as the conformal image of a circle, determined by breadth, draught and area.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// y + i z = scale (zeta + a1 / zeta + a3 / zeta^3) with zeta = e^{i alpha}: alpha = -pi/2 is the keel, 0 the waterline
// at y = breadth/2 (y to port, z up from the waterline).
struct LewisForm {
  double scale = 0;  // m
  double a1 = 0;
  double a3 = 0;

  Complex point(double alpha) const;       // y + i z, m
  Complex derivative(double alpha) const;  // d(y + i z)/d alpha, m
  double area() const;                     // below the waterline, m^2
  double area_centre() const;              // z of its centroid, m, below 0
};

// The form of Lewis (1929) with this waterline breadth, draught (m) and area (m^2), all > 0. An area whose section
// would intersect itself or exceed its breadth is replaced by the nearest valid one (von Kerczek and Tuck 1969).
LewisForm lewis_form(double breadth, double draught, double area);

// Range of the area coefficient, area / (breadth draught), of valid forms.
struct AreaRange {
  double least, largest;
};
AreaRange lewis_area_range(double half_breadth_to_draught);

}  // namespace seaglint

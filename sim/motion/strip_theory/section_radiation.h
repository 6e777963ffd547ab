// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Section of a ship on deep water: the Lewis form, the conformal image of a circle with the breadth, draught and area
// of the section, and its radiation problem in sway, heave or roll: two-dimensional added mass and damping, and the
// potential on the contour, from which diffraction forces follow.

#include <array>

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

// e^z E1(z), E1(z) = int_z^inf e^{-t}/t dt, cut along the negative real axis (on it: the value from above). For z != 0
// in the upper half plane, Im z >= 0; relative error below 1e-6.
Complex scaled_exponential_integral(Complex z);

enum SectionMode { kSway = 0, kHeave = 1, kRoll = 2 };  // roll about the middle of the waterline
inline constexpr std::size_t kSectionModes = 3;

// Gauss points of the starboard-to-port half contour y >= 0, from keel to waterline.
inline constexpr std::size_t kContourPoints = 24;
struct Contour {
  std::array<double, kContourPoints> y, z;  // m
  std::array<double, kContourPoints> dy,
      dz;  // times the quadrature weight: n_y dl = dz, n_z dl = -dy, n into the water
};
Contour contour_of(const LewisForm& form);

// Per unit velocity e^{jwt} of each mode (roll: rad/s), at a wavenumber K = w^2/g > 0.
struct SectionRadiation {
  // Potential at the contour's points; even in y for heave, odd for sway and roll.
  std::array<std::array<Complex, kContourPoints>, kSectionModes> potential;
  // Amplitude of the waves radiated to y > 0, per unit amplitude of the motion: |eta| = value |x|.
  std::array<double, kSectionModes> radiated_wave_ratio;

  // int phi_k n_j dl over both sides (m^2 to m^4): added mass -rho Re, damping rho w Im.
  Complex integral(const Contour& contour, SectionMode force, SectionMode motion) const;
  // Maximum error of the stream function in the boundary condition over its maximum value, per mode.
  std::array<double, kSectionModes> residual;
};
SectionRadiation solve_radiation(const LewisForm& form, const Contour& contour, double wavenumber);

}  // namespace seaglint

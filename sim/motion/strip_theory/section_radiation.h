// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Radiation problem of a cylinder of Lewis section in sway, heave or roll on deep water: two-dimensional added mass and
// damping, and the potential on the contour, from which diffraction forces follow.

#include <array>

#include "sim/core/numbers/linear.h"
#include "sim/motion/strip_theory/lewis_form.h"

namespace seaglint {

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

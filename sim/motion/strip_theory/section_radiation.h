// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Waves radiated by a long cylinder of Lewis section that heaves, sways or rolls on deep water: two-dimensional added
// mass, damping, and the potential on the contour from which diffraction forces follow.

#include <array>

#include "sim/core/numbers/linear.h"
#include "sim/motion/strip_theory/lewis_form.h"

namespace seaglint {

enum SectionMode { kSway = 0, kHeave = 1, kRoll = 2 };  // roll about the waterline's middle
inline constexpr std::size_t kSectionModes = 3;

// Gauss points of the starboard-to-port half contour y >= 0, from keel to waterline.
inline constexpr std::size_t kContourPoints = 24;
struct Contour {
  std::array<double, kContourPoints> y, z;  // m
  std::array<double, kContourPoints> dy,
      dz;  // with the quadrature's weight: n_y dl = dz, n_z dl = -dy, n into the water
};
Contour contour_of(const LewisForm& form);

// Per unit velocity e^{jwt} of each mode (roll: rad/s), at a wavenumber K = w^2/g > 0.
struct SectionRadiation {
  // Potential at the contour's points; even in y for heave, odd for sway and roll.
  std::array<std::array<Complex, kContourPoints>, kSectionModes> potential;
  // Amplitude of the waves sent out to y > 0, per unit amplitude of the motion: |eta| = value |x|.
  std::array<double, kSectionModes> radiated_wave_ratio;

  // int phi_k n_j dl over both sides (m^2 to m^4): added mass -rho Re, damping rho w Im.
  Complex integral(const Contour& contour, SectionMode force, SectionMode motion) const;
  // The largest error of the boundary condition's stream function over its largest value, by mode.
  std::array<double, kSectionModes> residual;
};
SectionRadiation solve_radiation(const LewisForm& form, const Contour& contour, double wavenumber);

}  // namespace seaglint

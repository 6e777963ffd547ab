// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reflected field of a beam at a material surface, and the field radiated by its surface currents.

#include <vector>

#include "sim/scattering/coefficients/material.h"

namespace seaglint {

// Field of one beam at one wavenumber, per h and v transmit polarisation.
struct BeamField {
  CVec3 h = CVec3::Zero();
  CVec3 v = CVec3::Zero();
};

// Component of a complex vector E along a real vector a.
inline Complex component_along(const Vec3& a, const CVec3& E) { return a.x() * E.x() + a.y() * E.y() + a.z() * E.z(); }

// Field of the reflected plane wave for incidence of E along d on a surface with normal n towards the wave: te (s.E) s
// + tm (p.E) p' (material.h).
CVec3 reflected_field(const InterfaceCoefficients& surface, const Vec3& d, const Vec3& n, const CVec3& E);

// Pattern vector of the surface currents of the total field towards r^, per unit of projected area:
//
//     (1/2) [n x eta H + r^ x (n x E)] / |n.d|,   E = E_i + E_r - E_t,  eta H = d x E_i + d' x E_r - d x E_t,
//
// from E_s = -(jk/4 pi) (e^{-jkr}/r) integral [eta (J - r^ r^.J) - r^ x M] e^{jk r^.x} dS with J = n x H, M = -n x E
// (Balanis, Advanced Engineering Electromagnetics, eqs. 6-122). E_t: field behind an air-backed sheet, 0 for all other
// surfaces. A perfect conductor gives n x (d x E_i) / |n.d|.
CVec3 radiated_field(const InterfaceCoefficients& surface, const Vec3& d, const Vec3& n, const Vec3& r_hat,
                     const CVec3& E);

}  // namespace seaglint

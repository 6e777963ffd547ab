// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The field that a beam carries from one material surface to the next, and the surface currents it leaves.

#include <vector>

#include "sim/scattering/material/material.h"

namespace seaglint {

// Of one beam at one wavenumber, for each transmitted polarisation.
struct BeamField {
  CVec3 h = CVec3::Zero();
  CVec3 v = CVec3::Zero();
};

// The component of a complex vector along a real one.
inline Complex component_along(const Vec3& a, const CVec3& E) { return a.x() * E.x() + a.y() * E.y() + a.z() * E.z(); }

// The field E of a plane wave along d after a surface with normal n towards it: te (s.E) s + tm (p.E) p' (material.h).
CVec3 reflected_field(const InterfaceCoefficients& surface, const Vec3& d, const Vec3& n, const CVec3& E);

// What the surface currents of the total field radiate along r^, as the footprint's pattern takes it:
//     (1/2) [n x eta H + r^ x (n x E)] / |n.d|,   E = E_i + E_r - E_t,  eta H = d x E_i + d' x E_r - d x E_t,
// from E_s = -(jk/4 pi) (e^{-jkr}/r) integral [eta (J - r^ r^.J) - r^ x M] e^{jk r^.x} dS with J = n x H, M = -n x E
// (Balanis, Advanced Engineering Electromagnetics, eqs. 6-122). E_t is the field behind a sheet that lets the wave
// through, 0 for all else. A perfect conductor gives n x (d x E_i) / |n.d|.
CVec3 radiated_field(const InterfaceCoefficients& surface, const Vec3& d, const Vec3& n, const Vec3& r_hat,
                     const CVec3& E);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Edge diffraction where a face is no perfect conductor: Keller's field of the impedance wedge, or of a thin sheet's
// edge, less the physical optics of the same surfaces, as equivalent edge currents.
//
// In the plane normal to the edge the soft and the hard wave (E and H along the edge) are separate. A face enters with
// the impedance that has its reflection coefficient at the angle of the wave, the mean of the values of incident and
// exit direction: exact for the pole of the reflection boundary, and reciprocal. At oblique incidence, where no closed
// solution exists for two impedances, the coefficient is the one from E_t to E_t (H_t to H_t) of the face; conversion
// between the two enters only through physical optics.
//
// Thin sheets, with air behind. R and T of the sheet referred to its middle split the field into an even and an odd
// part that reflect with R + T and R - T: each is a half-plane problem in one half-space, a junction (N = 1) of the
// sheet's impedance with a hard (even) or soft (odd) plane (resistive and conductive sheet conditions, Senior and
// Volakis 1995, ch. 2 and 3). The normal polarisation of a dielectric makes sin(theta) of the even part vanish at
// normal incidence, as B (a^2 - c^2) with c = cos phi: these factors are split by Wiener and Hopf, sqrt((a - c) / (a +
// c)) for each direction, where |a| is below about 1 (kNormalPolarisationWindow); otherwise the impedance is that of
// the angle. The even sine is the geometric mean of both directions, with which the edge of a weak sheet radiates the
// field of its polarisation.

#include <array>

#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/coefficients/wedge.h"

namespace seaglint {

// Materials of the faces of a wedge at one wavenumber. Both are the same surface for a sheet with air behind (N = 2).
struct MaterialFaces {
  std::array<const MaterialSurface*, 2> face;
  double k = 0;  // rad/m
  bool is_sheet = false;
};

// As equivalent_edge_currents() (wedge_diffraction.h): p . current is S per metre of edge for received polarisation p
// (unit) in direction s (unit), for waves along k_hat with electric fields `fields`; physical optics is subtracted on
// faces that are illuminated and visible from s, or within `shadow` (rad) of a shadow boundary. N > 1. Off Keller's
// cone the amplitude is divided by the sines of both directions with the edge and multiplied by sqrt(1 - ((k^ - s) . t
// / 2)^2), which is reciprocal and follows Michaeli's current of the conducting half-plane seen broadside to 10 %. Zero
// for a wave from inside the body. Of two perfect conductors on the cone: equal to equivalent_edge_currents() to
// rounding.
std::array<CVec3, 2> material_edge_currents(const WedgeFrame& wedge, const MaterialFaces& faces, const Vec3& k_hat,
                                            const std::array<Vec3, 2>& fields, const Vec3& s, double shadow);

}  // namespace seaglint

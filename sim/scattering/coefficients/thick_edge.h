// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// First-order change in k t of the edge diffraction of a sheet of thickness t that ends in a square edge.
//
// Let phi and phi_0 be the angles of receiver and transmitter from the sheet's extension, c, s their cosines and sines,
// C, S those of half of them, kappa = k sin b with b between wave and edge, and P the amplitude of the field across the
// edge, u = P sqrt(2 / pi kappa r) e^{-j kappa r + j pi/4}. The thin half-plane has P = j C C_0 / (c + c_0) for the
// field parallel to the edge (soft) and -j S S_0 / (c + c_0) for the magnetic field parallel to it (hard). Moving both
// faces outwards by t/2 changes it, by Hadamard's variation of the boundary, by
//
//     soft  (j/4) integral (t/2) du/dn du_0/dn ds,      hard  (j/4) integral (t/2) (kappa^2 u u_0 - du/ds du_0/ds) ds
//
// over both faces, u and u_0 the exact half-plane fields for the two directions. With the Laplace transforms along the
// face, 2 sqrt(q (1 + c_0)) sqrt(p + q) / (p + q c_0) of the sum of the currents and 2 sqrt(q (1 - c_0)) / (sqrt(p + q)
// (p + q c_0)) of the difference of the fields, q = j kappa, both integrals lead to
//
//     M = (1/pi) [ -gamma - ln(2j kappa eps) + (phi s + phi_0 s_0) / (c + c_0) ].
//
// The logarithm comes from a cut at eps before the edge, where the squared currents fall as 1/s. Near the edge the
// field is static; the conformal map of the square end, z = (t/pi) (zeta^2 - 1/2 - ln 2 zeta) far from it, gives eps =
// t / (4 pi e). Hence
//
//     delta P soft = -(kappa t / 2) [ C C_0 M + s s_0 / (2 (c + c_0)) ]
//     delta P hard =  (kappa t / 2) [ S S_0 M + (1 + c c_0) / (2 (c + c_0)) ].
//
// The sheet is meshed at its illuminated face: j kappa (t/2) (s + s_0) P, the phase of a face t/2 before the middle, is
// subtracted, and the rest has no pole on the reflection boundary. Received on the other side of the sheet, phases
// refer to its middle. S per metre is (j / pi sin^2 b) (delta P_soft E_t t + delta P_hard H_t t x s); off Keller's cone
// sin^2 b is the product of the sines of both directions, which keeps reciprocity. Exact solutions of the thick
// half-plane: D. S. Jones, Proc. R. Soc. A 217 (1953) 153-175; J. L. Volakis and M. A. Ricoy, IEEE Trans. AP-35 (1987)
// 62-72.

#include <array>

#include "sim/scattering/coefficients/wedge_diffraction.h"

namespace seaglint {

// Quantity of first order in k t: k t (constant + logarithm ln(k t)).
template <typename T>
struct FirstOrderThickness {
  T constant{}, logarithm{};
};

// Change by the thickness of the edge's equivalent_edge_currents(), in the same units: p . current adds to S per metre
// of edge, for received polarisation p (unit) in direction s (unit). wedge: a WedgeFrame with N = 2; k_hat: direction
// of incidence, unit; fields: two incident electric fields. Reciprocal; finite everywhere.
std::array<FirstOrderThickness<CVec3>, 2> thick_edge_currents(const WedgeFrame& wedge, const Vec3& k_hat,
                                                              const std::array<Vec3, 2>& fields, const Vec3& s);

// Relative change by the thickness of a hard wave between the direction `towards` (source or receiver, unit) and a
// direction along the sheet, -j kappa t S_0 [ S_0 (1 - gamma - ln(kappa t / 2 pi) - j pi / 2) / pi + C_0 (1 - phi_0 /
// pi) ]: once for every free edge at which the wave is launched, received or diffracted again; phi_0 = pi for a wave
// along the sheet. The mean of both faces.
FirstOrderThickness<Complex> thick_edge_wave_change(const WedgeFrame& wedge, const Vec3& towards);

}  // namespace seaglint

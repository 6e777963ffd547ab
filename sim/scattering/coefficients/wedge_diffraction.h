// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// An infinite wedge with perfectly conducting faces.

#include <array>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/coefficients/fade_windows.h"

namespace seaglint {

// Frame of one face of a wedge, unit vectors: x into the face, normal to the edge; n out of the conductor; t = x x n
// along the edge.
struct WedgeFace {
  Vec3 x, n, t;
};

// Smallest wedge index N: concave edges with less than 12 deg between their faces do not diffract; beams follow their
// reflections.
inline constexpr double kMinWedgeIndex = 1.0 / 15;

// An infinite wedge with perfectly conducting faces. The second face's t is minus the first one's.
struct WedgeFrame {
  WedgeFace face[2];
  // Wedge index, exterior angle / pi, kMinWedgeIndex <= N <= 2: 2 half-plane, 3/2 convex right angle, below 1 concave.
  double N = 2;
  double thickness_m = 0;  // of a half-plane, m (thick_edge_currents())
};

// Diffraction by a sharp edge of a perfect conductor as a line of equivalent currents: the exact surface current of the
// infinite wedge less that of physical optics (the fringe current of Ufimtsev's physical theory of diffraction),
// integrated over both faces.
//
// A. Michaeli, "Equivalent edge currents for arbitrary aspects of observation", IEEE Trans. AP-32 (1984) 252-258, and
// "Elimination of infinities in equivalent edge currents, part I: fringe current components", AP-34 (1986) 912-918. The
// faces are integrated along the grazing diffracted ray, so that the result is finite in every direction but one: the
// forward direction of a wave incident at grazing on a face.

// Fringe current per metre of edge for a plane wave of unit amplitude along `k_hat` (unit) with electric field E
// (normal to it): p . fringe_current(...) is the field amplitude S / length towards s (unit) for received polarisation
// p, dimensionless and independent of frequency. Phase reference: the incident wave at the edge point, e^{jk s.x} on
// exit. Zero for a wave from inside the conductor. For N < 1 physical optics comprises all reflections between the
// faces; for N = 1/2, 1/3, ... these are exact and the result is zero.
Vec3 fringe_current(const WedgeFrame& wedge, const Vec3& k_hat, const Vec3& E, const Vec3& s);

// Equivalent edge currents for two fields: as fringe_current(), but physical optics is subtracted only on faces that
// are both illuminated and visible from s, since a face radiates only into its own half-space. Faces plus edge then
// give Keller's field on either side of a face. Within `shadow` (rad) of a shadow or reflection boundary, where
// Keller's field is infinite, the fringe current is returned.
std::array<Vec3, 2> equivalent_edge_currents(const WedgeFrame& wedge, const Vec3& k_hat,
                                             const std::array<Vec3, 2>& fields, const Vec3& s,
                                             double shadow = kShadowBoundaryGuard);

// Face-grazing diffracted wave that an edge launches along a face under hard-polarised plane waves of unit amplitude
// along k_hat with electric fields `fields`. It propagates along `direction`, in the face on Keller's cone. Its
// electric field along the face normal n at distance l > 0 from the edge is amplitude e^{-jkl} / sqrt(k l); half of it
// is the incident field for an edge that it meets (J. B. Keller, J. Opt. Soc. Am. 52 (1962) 116-130: his hard
// coefficient towards the face).
struct GrazingDiffractedWave {
  Vec3 direction;
  std::array<Complex, 2> amplitude;
  double launch_parameter = 1;  // transition_parameter() on the cone, of the incident wave or image nearest to grazing
};
GrazingDiffractedWave grazing_diffracted_wave(const WedgeFrame& wedge, int face, const Vec3& k_hat,
                                              const std::array<Vec3, 2>& fields);

// Distance of a wave along a face from a shadow boundary: d = (1 - w.s) / 2, half the path difference per metre of
// face, > 0 also for equal directions. along_face: w; other: s, the incident wave's direction at the edge that launches
// w, or the exit direction at the edge where w ends. The transition function's argument is X = 2 k l d. On Keller's
// cone d = sin^2 b sin^2(half the angle about the edge), as L = l sin^2 b of a plane wave on a wedge (Kouyoumjian and
// Pathak 1974); off the cone the current truncated at an edge has this phase along the face, and the fringe current the
// same pole.
double transition_parameter(const Vec3& along_face, const Vec3& other);

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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Diffraction by a sharp edge of a perfect conductor as a line of equivalent currents: the exact surface current of the
// infinite wedge less that of physical optics (the fringe current of Ufimtsev's physical theory of diffraction),
// integrated over both faces.
//
// A. Michaeli, "Equivalent edge currents for arbitrary aspects of observation", IEEE Trans. AP-32 (1984) 252-258, and
// "Elimination of infinities in equivalent edge currents, part I: fringe current components", AP-34 (1986) 912-918. The
// faces are integrated along the grazing diffracted ray, so that the result is finite in every direction but one: the
// forward direction of a wave incident at grazing on a face.

#include <array>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/coefficients/wedge.h"

namespace seaglint {

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

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Diffraction by a sharp edge of a perfect conductor as a line of equivalent currents: the part of the wedge's exact
// surface current that geometrical optics lacks (the fringe current of Ufimtsev's physical theory of diffraction),
// integrated over both faces.
//
// A. Michaeli, "Equivalent edge currents for arbitrary aspects of observation", IEEE Trans. AP-32 (1984) 252-258, and
// "Elimination of infinities in equivalent edge currents, part I: fringe current components", AP-34 (1986) 912-918: the
// faces are integrated along the diffracted ray that grazes them, so the result is finite in every direction but the
// grazing ray's own of a wave that grazes the face already.

#include <array>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/diffraction/wedge.h"

namespace seaglint {

// The fringe current: the wedge's answer in direction s to a plane wave of unit amplitude along `k_hat` with electric
// field E (across it) without that of physical optics on the faces that the wave lights, per metre of edge: p .
// fringe_current(...) is the field amplitude S / length, dimensionless, independent of frequency, for the received
// polarisation p. Phase: e^{jk s.x} of the edge's point and that of the incident wave there. Zero when the wave comes
// from inside the conductor. In a corner physical optics is that of all its reflections; where N is 1 / 2, 1 / 3, ...
// they are exact and nothing is left.
Vec3 fringe_current(const WedgeFrame& wedge, const Vec3& k_hat, const Vec3& E, const Vec3& s);

// What facets leave to the edge, for two fields at once, which share everything that costs time: the same without
// physical optics only on lit faces that s sees too, since facets radiate to nowhere else. With theirs it is Keller's
// field on either side of a face. Within `shadow` of a boundary of shadow, where his is infinite, the fringe current.
inline constexpr double kShadowBoundaryGuard = 0.26;  // rad, 15 deg: of the grazing ray's angle against the wave's
std::array<Vec3, 2> equivalent_edge_currents(const WedgeFrame& wedge, const Vec3& k_hat,
                                             const std::array<Vec3, 2>& fields, const Vec3& s,
                                             double shadow = kShadowBoundaryGuard);

// Fields of the edge waves that hard-polarised plane waves send along a face: unit amplitude along k_hat, electric
// fields `fields`. The wave travels along `direction` (in the face, on Keller's cone) and its electric field across the
// face at distance l > 0 from the edge is amplitude e^{-jkl} / sqrt(k l), half of it the incident wave for an edge it
// meets (J. B. Keller, J. Opt. Soc. Am. 52 (1962) 116-130: his hard coefficient towards the face). The field along n.
struct GrazingDiffractedWave {
  Vec3 direction;
  std::array<Complex, 2> amplitude;
  double launch_parameter = 1;  // transition_parameter() on the cone, of the wave next to grazing the face
};
GrazingDiffractedWave grazing_diffracted_wave(const WedgeFrame& wedge, int face, const Vec3& k_hat,
                                              const std::array<Vec3, 2>& fields);

// How far a wave along a face is from another direction's shadow boundary: half of what their paths differ by per metre
// of face, (1 - w.s) / 2, least and never zero where they agree. `other` is the incident wave's direction at the edge
// where the wave along the face starts, and the outgoing one's at the edge where it ends. On Keller's cone this is
// sin^2 b times the sine squared of half the angle about the edge (Kouyoumjian and Pathak 1974, a plane wave on a
// wedge: L = l sin^2 b); off it the current that ends at an edge has this phase along the face, and the fringe current
// the same pole.
double transition_parameter(const Vec3& along_face, const Vec3& other);

}  // namespace seaglint

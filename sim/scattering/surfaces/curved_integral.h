// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The phase integral of a footprint on a curved surface as terms that hold over a band and a small turn.

#include <array>
#include <vector>

#include "sim/scattering/surfaces/curved_footprint.h"

namespace seaglint {

// Currents fade towards the shadow boundary as t^3 (10 - 15 t + 6 t^2), t = sin(elevation over the surface) /
// (kTransitionZoneWidth (kappa / k)^(1/3)), 0..1. (kappa / k)^(1/3) is the width of Fock's transition region (V. A.
// Fock, J. Phys. USSR 10, 1946, 130-136). Half of it keeps the fading out of the specular zone down to kR = 15; between
// 0.3 and 2 nothing changes above kR = 40.
inline constexpr double kTransitionZoneWidth = 0.5;

// Contour terms with the local slope stand for an area where k slope^2 exceeds this many times the change of that slope
// per metre of surface: beside a specular point they err by its inverse, and elsewhere what they leave out ends in the
// fading.
inline constexpr double kContourRatio = 50;

// A part of the phase integral: amplitude varies slowly with k and direction, the phase is e^{jk psi}. The point
// belongs to the body and slides on it as the direction turns, which adds slide1 h + slide2 v to the gradient of psi.
struct CurvedContribution {
  Complex integral;  // m^2, without the phase; fading included, pattern not
  double psi = 0;    // m
  Vec2 p = Vec2::Zero();
  double slide1 = 0, slide2 = 0;
};

// Terms of a footprint with curvature that hold at k and, where `min_slope` > 0, while the slope of psi along the
// surface changes by kMaxAmplitudeError min_slope. Where psi has slope enough these are the contour's ends and edges
// with the local slope, whose terms cancel where two smooth facets meet; elsewhere pieces of half-phase below
// kMaxHalfPhase, integrated with the quadratic phase. The triangle and its halves decide, never the lit part of it.
void curved_contributions(const Footprint& footprint, double k, double min_slope,
                          std::vector<CurvedContribution>& terms);

// Pattern at a point, between those at the facet's corners. Where materials make it depend on the wavenumber only the
// flat facet's is known: that is `flat`, whichever wavenumber it belongs to.
std::array<Complex, 4> pattern_at(const Footprint& footprint, const Vec2& p, const std::array<Complex, 4>& flat);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Phase integrals of a footprint: integral of e^{jk psi(p)} d^2p over its polygon.

#include <vector>

#include "sim/scattering/observation/frequency_band.h"
#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/radiation/surface_radiation.h"

namespace seaglint {

// Relative error of a frozen amplitude per end point, -28 dB; the error of a sum over many is far smaller.
inline constexpr double kMaxAmplitudeError = 0.04;
// Phase from its middle up to which a piece may be one point.
inline constexpr double kMaxHalfPhase = 0.5;  // rad
// The same of a curved piece by its slopes, whose phase is integrated by a rule of degree 5: its error, of the order
// x^6 / 6!, is 0.1 % here. What arises while a term holds, with another look direction, is not integrated.
inline constexpr double kMaxCurvedHalfPhase = 1;  // rad

// The integral over a polygon of the flat facet, m^2: Gordon's contour form (W. B. Gordon, IEEE Trans. AP-23, 1975,
// 590-592), by the divergence theorem with F = w e^{jk w.p} / (jk |w|^2); a series where |w| is small.
Complex flat_phase_integral(const Footprint& footprint, const MovingPolygon& polygon, double k);

// Contour terms with the local slope replace an area where k slope^2 exceeds this multiple of the change of the slope
// per metre of surface. Near a specular point their relative error is the inverse of it; elsewhere the omitted terms
// cancel at the taper.
inline constexpr double kContourRatio = 50;

// A term of the integral over a curved surface: the amplitude varies slowly with k and look direction, the phase is
// e^{jk psi}. The point slides on the body as the look direction changes, which adds slide1 h + slide2 v to the
// gradient of psi.
struct CurvedTerm {
  BandValues integral{};  // m^2, without the phase; with the taper, without the pattern
  double psi = 0;         // m
  Vec2 p = Vec2::Zero();
  double slide1 = 0, slide2 = 0;
};

// Terms of a footprint with curvature that hold over the band and, for `min_slope` > 0, while the slope of psi along
// the surface changes by kMaxAmplitudeError min_slope. Where the slope is large enough these are end points and edges
// of the contour with the local slope, which cancel where two smooth facets meet; elsewhere pieces of half-phases below
// these limits, integrated with the full phase. The triangle, or the rectangle around it and its halves
// determine the choice, not their illuminated part. The form and the taper are those of the centre of the FormRange.
std::vector<CurvedTerm> curved_terms(const Footprint& footprint, const FrequencyBand& band, double min_slope);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Phase integral of a footprint on a curved surface, as terms that hold over a band and a small aspect change. The band
// determines the terms once; their amplitudes follow at each of its nodes.

#include <array>
#include <vector>

#include "sim/scattering/observation/frequency_band.h"
#include "sim/scattering/radiation/curved_footprint.h"

namespace seaglint {

// Contour terms with the local slope replace an area where k slope^2 exceeds this multiple of the change of the slope
// per metre of surface. Near a specular point their relative error is the inverse of it; elsewhere the omitted terms
// cancel at the taper.
inline constexpr double kContourRatio = 50;

// A term of the phase integral: the amplitude varies slowly with k and look direction, the phase is e^{jk psi}. The
// point slides on the body as the look direction changes, which adds slide1 h + slide2 v to the gradient of psi.
struct CurvedContribution {
  BandValues integral;  // m^2, without the phase; with the taper, without the pattern
  double psi = 0;       // m
  Vec2 p = Vec2::Zero();
  double slide1 = 0, slide2 = 0;
};

// Appends the terms of a footprint with curvature that hold over the band and, for `min_slope` > 0, while the slope of
// psi along the surface changes by kMaxAmplitudeError min_slope. Where the slope is large enough these are end points
// and edges of the contour with the local slope, which cancel where two smooth facets meet; elsewhere pieces of
// half-phase below kMaxHalfPhase, integrated with the full phase. The triangle, or the rectangle around it and its
// halves determine the choice, not their illuminated part. The form and the taper are those of the centre of the
// FormRange.
void curved_contributions(const Footprint& footprint, const FrequencyBand& band, double min_slope,
                          std::vector<CurvedContribution>& terms);

// Pattern at the point p, interpolated between the vertices of the facet. With materials other than perfect conductors
// only the pattern of the flat facet is available: `flat`, at any wavenumber.
std::array<Complex, 4> pattern_at(const Footprint& footprint, const Vec2& p, const std::array<Complex, 4>& flat);

}  // namespace seaglint

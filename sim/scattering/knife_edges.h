// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Beams that two rims cut one after the other. Behind the first rim, of a mirror, light does not end in a line: over a way d it is spread by sqrt(lambda d)
// to either side, as much into the shadow as is missing beside it. Physical optics of the last facet ends it in a line, which is right but where a second
// rim, of a later mirror or of the last facet, lies within that width and takes only one half of it: at the rims of dihedrals and square trihedrals seen on
// their axis.
//
// Fresnel diffraction by two parallel screens in a row (G. Millington, R. Hewitt and F. S. Immirzi, Proc. IEE 109C (1962) 419-429), received along the wave:
// with E the field of a half-plane, u its argument, w the second rim's distance from the first one's shadow line, d the way between them,
//
//     -integral over the half-line from w on of (E(-x) - 0) dx = -sqrt(2 d / k) e^{-j pi/4} / (2 sqrt(pi)) e^{-ju^2} (1 - F(u^2)),   u^2 = k (sqrt(d^2 + w^2) - d)
//
// metres wide is what is lacking of the beam on either side of the shadow line (E is odd about it), F as in fringe.h.

#include <span>
#include <vector>

#include "sim/scattering/edge_footprint.h"
#include "sim/scattering/edges.h"
#include "sim/scattering/edges.h"
#include "sim/scattering/panels.h"

namespace seaglint {

// What a beam passes: one of its mirrors, or the facet at its end.
struct Screen {
  int facet = -1;                    // its panel goes by
  const Mirror* mirrors = nullptr;   // that take its own points to where the beam meets them
  const ImagePlane* plane = nullptr;
  Vec3 direction = Vec3::Zero();     // of the wave at it
};

// Appends what is lacking of a footprint between each two nearly parallel rims of `screens`, of which the first lies nearest to the transmitter and the last is
// the footprint's own facet. They fade out where Fresnel's form for half-planes ends (README.md, "Between two rims"): off the wave's direction across the rims, far from the
// beam, where rims cross, at panels narrower than the light's spread.
void find_knife_edges(const SharpEdges& edges, const Panels& panels, const RadarBasis& transmit, std::span<const Screen> screens,
                      const Footprint& footprint, std::vector<EdgeFootprint>& out);

// What one returns at most at the lowest of some wavenumbers, m; 0 where it has faded out at all of them.
double bound_of_knife_edges(const EdgeFootprint& footprint, double lowest, double highest);

}  // namespace seaglint

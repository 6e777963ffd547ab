// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Smooth surfaces with no more facets than their curvature requires, so that the cost of a view does not follow the
// fineness of the mesh.

#include <vector>

#include "sim/geometry/surface/smooth_surface.h"

namespace seaglint {

struct MergedFacets {
  std::vector<Facet> facets;
  SmoothSides smooth;
};

// Angle between a merged facet and the normals of the surface at its corners, at most: a circle keeps 120 sides. It
// limits the error of paths that go on from a curved reflector to another panel: an ellipsoid over a plate changes by
// -34 dB of the echo, with 0.0524 by -17 dB; its own echo by less than -50 dB with either.
inline constexpr double kMaxFacetTilt = 0.0262;  // rad, 1.5 deg

// The same surface without vertices inside smooth surfaces that larger curved facets (SmoothSurface) replace: every
// removed vertex lies within `tolerance` (m) of the facet that replaces it, measured from the height of the surface
// over it, and no merged facet is tilted by more than kMaxFacetTilt. Vertices on sides that are not smooth stay. Merged
// facets carry the normals of the fine mesh at their corners. Half-edge collapse with its link condition (H. Hoppe et
// al., Proc. SIGGRAPH 1993, 19-26).
MergedFacets merge_smooth_facets(std::vector<Facet> facets, SmoothSides smooth, double tolerance);

}  // namespace seaglint

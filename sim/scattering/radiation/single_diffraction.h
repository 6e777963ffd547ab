// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Single diffraction: finds the illuminated intervals of sharp edges and computes their contributions.
//
// An interval of an edge is illuminated directly or after reflections; exit paths are found by tracing the receiver's
// wave back to the edge (reciprocity). Each pair of an incident and an exit path with a common interval is one
// contribution.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/coefficients/material_edge.h"
#include "sim/scattering/radiation/edge_contribution.h"
#include "sim/scattering/scatterer/sharp_edges.h"
#include "sim/scattering/tracing/edge_illumination.h"

namespace seaglint {

// Maximum number of reflections on the incident and the exit path together: the edges of corner reflectors need three.
inline constexpr int kMaxEdgeReflections = 3;

// A wave on a panel after reflections, as a beam segment carries it.
struct FacetWave {
  const RadarBasis& antenna;
  const ImageTransform& image_transform;
  const DepthPlane& plane;  // of the panel's image
  Vec3 direction, E_h, E_v;
  int bounce = 1;                              // 1-based number of the reflection at this panel
  bool on_conductor = true;                    // the panel is a smooth perfect conductor
  Vec3 first_reflector_normal = Vec3::Zero();  // as in EdgeIllumination
};

// Appends the intervals of the sharp edges of a panel (given by its representative facet) that bound the illuminated
// part, `illuminated`: convex polygons in the projection plane.
void find_edge_illumination(const SharpEdges& edges, int facet, const FacetWave& wave,
                            std::span<const MovingPolygon> illuminated, std::vector<EdgeIllumination>& illuminations);

// Appends the contributions of all intervals of an edge common to an illumination by the transmitter (`incoming`) and
// one by the receiver (`outgoing`), with at most `max_bounces` interactions, the diffraction included. For one antenna
// the two lists are the same object, and two reciprocal paths are one contribution. Multiple diffraction is in
// multiple_diffraction.h. `materials`:
// surfaces of both faces for each wavenumber, ascending, where one is no perfect conductor; else empty.
void append_single_diffraction(const SharpEdge& edge, std::span<const Facet> facets, const BistaticGeometry& geometry,
                               EdgeIlluminations incoming, EdgeIlluminations outgoing, int max_bounces,
                               std::span<const MaterialFaces> materials, std::vector<EdgeContribution>& contributions);

}  // namespace seaglint

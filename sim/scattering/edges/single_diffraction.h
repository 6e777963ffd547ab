// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Which stretches of sharp edges does the wave reach, by which mirrors, and what do they send back?
//
// A wave reaches a stretch of an edge directly or by mirrors; what the edge sends back leaves by any of the ways on
// which the receiver's wave, sent backwards, would reach it (reciprocity). Every pair of an arrival and a departure
// that share a stretch is one echo.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/edges/edge_contribution.h"
#include "sim/scattering/edges/edge_illumination.h"
#include "sim/scattering/target/sharp_edges.h"

namespace seaglint {

// Mirrors on both ways together. Three suffice for what a corner reflector's rims return; what is left out has left the
// target's straight ways.
inline constexpr int kMaxEdgeReflections = 3;

// A wave that falls on a facet through mirrors, as a beam's leg carries it.
struct FacetWave {
  const RadarBasis& antenna;
  const ImageTransform& image_transform;
  const DepthPlane& plane;  // of the facet's image
  Vec3 direction, E_h, E_v;
  int bounce = 1;                              // of the hit on the facet
  Vec3 first_reflector_normal = Vec3::Zero();  // as in EdgeIllumination
};

// Appends the stretches of the sharp edges of a panel (by the facet it goes by) that bound what the wave lights of it
// (convex pieces of the aperture).
void find_edge_illumination(const SharpEdges& edges, int facet, const FacetWave& wave,
                            std::span<const MovingPolygon> illuminated, std::vector<EdgeIllumination>& illuminations);

// Appends the echoes of all stretches of an edge that a wave from the transmitter (`incoming`) shares with one from the
// receiver (`outgoing`), with at most `max_bounces` in all. When both are one antenna the lists are the same. Edge
// waves are apart (multiple_diffraction.h).
void append_single_diffraction(const SharpEdge& edge, std::span<const Facet> facets, const BistaticGeometry& geometry,
                               EdgeIlluminations incoming, EdgeIlluminations outgoing, int max_bounces,
                               std::vector<EdgeContribution>& contributions);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Interactions with sharp edges: the intervals of an edge that a wave illuminates, directly or after reflections.
// Collected per beam, queried per edge.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/scatterer/panels.h"
#include "sim/scattering/tracing/interaction.h"

namespace seaglint {

// One wave on an interval of one edge.
struct EdgeIllumination {
  int edge = kNoEdge;
  std::array<double, 2> s{};                   // of the interval, m from the edge's start
  std::array<Vec2, 2> slide{};                 // d s / d (d1, d2) of its ends with the antenna's look direction, m/rad
  Vec3 image_start;                            // image of the edge's start
  Vec3 image_edge_direction;                   // of the edge's image, unit
  Vec3 direction;                              // propagation direction at the edge, unit
  Vec3 E_h, E_v;                               // field at the edge for each polarisation of the antenna
  std::uint8_t reflections = 0;                // before the edge
  Vec3 first_reflector_normal = Vec3::Zero();  // unfolded to the edge, unit; zero without reflections
};

// Maximum number of reflections on the incident and the exit path together: the edges of corner reflectors need three.
inline constexpr int kMaxEdgeReflections = 3;

// True when the waves of this beam segment are recorded at edges: at most kMaxEdgeReflections reflections before the
// edge.
bool records_edges(const TracingContext& scene, const BeamSegment& segment);

// Appends the intervals of the panel's sharp edges that bound its illuminated polygons, for waves that met only perfect
// conductors before: at perfectly conducting wedges of smooth conductors, and for direct waves at edges of materials.
void record_edges(const TracingContext& scene, const Interaction& interaction,
                  std::vector<EdgeIllumination>& illuminations);

using EdgeIlluminations = std::span<const EdgeIllumination* const>;

// Illumination of every edge. Holds the lists as they were collected and an index sorted by edge: a copy would move
// megabytes.
class IlluminationByEdge {
 public:
  IlluminationByEdge() = default;
  // The entries of one edge keep the order of the lists.
  IlluminationByEdge(std::vector<std::vector<EdgeIllumination>> lists, std::size_t edge_count);
  IlluminationByEdge(IlluminationByEdge&&) = default;
  IlluminationByEdge& operator=(IlluminationByEdge&&) = default;

  EdgeIlluminations of(int edge) const { return all().subspan(first_[edge], first_[edge + 1] - first_[edge]); }
  EdgeIlluminations all() const { return sorted_; }  // ascending by edge
  // First edge with at least this many entries before it; the number of edges if there is none.
  int edge_after(std::size_t arrivals) const;

 private:
  std::vector<std::vector<EdgeIllumination>> lists_;
  std::vector<const EdgeIllumination*> sorted_;
  std::vector<std::size_t> first_{0};  // offset of each edge, and the end
};

}  // namespace seaglint

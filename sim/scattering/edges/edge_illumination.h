// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Waves that reach stretches of sharp edges, found beam by beam and asked for edge by edge.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/target/sharp_edges.h"

namespace seaglint {

// A wave on a stretch of an edge.
struct EdgeIllumination {
  int edge = kNoEdge;
  std::array<double, 2> s{};                   // the stretch, m from the edge's start
  std::array<Vec2, 2> slide{};                 // d s / d (d1, d2) of its ends as the antenna's direction turns, m/rad
  Vec3 image_start;                            // of the edge's start, through the mirrors
  Vec3 image_edge_direction;                   // unit, of the edge's direction
  Vec3 direction;                              // of the wave at the edge, unit
  Vec3 E_h, E_v;                               // field for each polarisation of the antenna
  std::uint8_t reflections = 0;                // passed before
  Vec3 first_reflector_normal = Vec3::Zero();  // normal of the first of them, unit, as the others show it to the edge
};

using EdgeIlluminations = std::span<const EdgeIllumination* const>;

// Every edge's arrivals. They stay where they were found: together they are megabytes.
class IlluminationByEdge {
 public:
  IlluminationByEdge() = default;
  // Those of one edge are in the order of the lists.
  IlluminationByEdge(std::vector<std::vector<EdgeIllumination>> lists, std::size_t edge_count);
  IlluminationByEdge(IlluminationByEdge&&) = default;
  IlluminationByEdge& operator=(IlluminationByEdge&&) = default;

  EdgeIlluminations of(int edge) const { return all().subspan(first_[edge], first_[edge + 1] - first_[edge]); }
  EdgeIlluminations all() const { return sorted_; }  // in ascending order of their edges
  // The first edge that has at least this many arrivals before it, or the number of edges.
  int edge_after(std::size_t arrivals) const;

 private:
  std::vector<std::vector<EdgeIllumination>> lists_;
  std::vector<const EdgeIllumination*> sorted_;
  std::vector<std::size_t> first_{0};  // of each edge, and behind the last one
};

}  // namespace seaglint

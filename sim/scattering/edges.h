// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The sharp edges of a target: where two facets meet at an angle, and the rims of sheets.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/facets.h"
#include "sim/scattering/fringe.h"

namespace seaglint {

inline constexpr int kNoEdge = -1;

struct SharpEdge {
  Vec3 a, b;                       // runs along facet[0]'s side, that is with t of its face
  std::array<int, 2> facet{};      // equal at the rim of a sheet
  WedgeFrame outside;              // on the side of the normals
  WedgeFrame inside;               // the other one, of an open sheet
  bool open = false;               // the wave may come from either side

  double length() const { return (b - a).norm(); }
  const Vec3& along() const { return outside.face[0].t; }  // unit, from a to b
};

struct SharpEdges {
  std::vector<SharpEdge> edges;
  std::vector<std::array<int, 3>> of_facet;  // edge along corner[i] -> corner[i + 1], or kNoEdge
};

// Edges whose faces turn by at least `least_turn` (rad). Edges of three and more facets are left out: nobody can tell their wedge.
SharpEdges sharp_edges(std::span<const Facet> facets, double least_turn);

// The wedge a wave along k_hat meets, or nothing when it comes from the concave side, whose reflections the beams follow, or from within.
const WedgeFrame* wedge_towards(const SharpEdge& edge, const Vec3& k_hat);

}  // namespace seaglint

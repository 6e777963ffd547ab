// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The smooth surface behind a tessellation: vertex normals inside creases, how far the surface stands above its facets,
// and how it curves.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/target/facets.h"

namespace seaglint {

// Facets whose normals differ by less than this hang together smoothly. Fairings and hulls are cut into steps below 15
// deg, the sides of a modelled pipe or mast turn by 22 deg (16 sides) and more, knuckles and box edges by more still.
inline constexpr double kDefaultCreaseDeg = 20;

// One vertex as the facets of one smooth fan share it; a vertex on a sharp edge has one for each side.
struct SmoothVertex {
  Vec3 normal = Vec3::UnitZ();
  Mat3 curvature = Mat3::Zero();      // second fundamental form: t . curvature t is the normal curvature along the unit
                                      // tangent t, convex > 0, 1/m
  std::int32_t first = 0, count = 0;  // its facets in fan()
};

// A facet with what the surface does above it.
struct CurvedFacet {
  std::array<std::int32_t, 3> vertex{};
  std::array<double, 3>
      sagitta{};  // of the edge corner[i] -> corner[i+1] in its middle, along the mean of the two vertex normals, m
};

class SmoothSurface {
 public:
  // crease: 0 <= x <= pi, rad; 0 leaves every facet flat. A facet above which the surface stands by less than
  // `negligible` metres stays flat.
  SmoothSurface(std::span<const Facet> facets, double crease, double negligible);

  // Null where the facet is flat.
  const CurvedFacet* curved(int facet) const {
    return index_[facet] < 0 ? nullptr : &curved_[static_cast<std::size_t>(index_[facet])];
  }
  const SmoothVertex& vertex(int i) const { return vertices_[static_cast<std::size_t>(i)]; }
  std::size_t curved_count() const { return curved_.size(); }

  // How far a vertex lies inside the light of a source in `direction` (unit, towards it), as x = sin(elevation over the
  // surface) / kappa^(1/3), m^(1/3), with kappa the curvature along the ray; no more than 0 where a facet of its fan
  // faces away, infinite where the surface does not bend away. side: -1 to look at the back of a sheet.
  double shadow_boundary_distance(int vertex, const Vec3& direction, double side) const;

 private:
  std::vector<std::int32_t> index_;  // into curved_, -1 = flat
  std::vector<CurvedFacet> curved_;
  std::vector<SmoothVertex> vertices_;
  std::vector<std::int32_t> fan_;  // the facets of each vertex
  std::span<const Facet> facets_;
};

}  // namespace seaglint

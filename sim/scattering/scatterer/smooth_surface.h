// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Smooth surface approximated by a mesh: vertex normals between creases, height of the surface above its facets, and
// curvature.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/scatterer/smooth_sides.h"

namespace seaglint {

// Default crease angle. On fairings and hulls adjacent facets turn by less than 15 deg, on the sides of modelled pipes
// and masts (16 sides and fewer), knuckles and box edges by 22 deg and more.
inline constexpr double kDefaultCreaseDeg = 20;

// Vertex of one smooth fan of facets; a vertex on a sharp edge occurs once for each side.
struct SmoothVertex {
  Vec3 normal = Vec3::UnitZ();
  Mat3 curvature = Mat3::Zero();      // second fundamental form, 1/m: t . curvature t is the normal curvature along the
                                      // unit tangent t, convex > 0
  std::int32_t first = 0, count = 0;  // its facets in fan_
};

// Facet of a curved surface.
struct CurvedFacet {
  std::array<std::int32_t, 3> vertex{};
  std::array<double, 3> sagitta{};  // height of the surface over the midpoint of side corner[i] -> corner[i+1], along
                                    // the mean of its two vertex normals, m
};

class SmoothSurface {
 public:
  // Facets over which the surface rises by less than `negligible` (m) stay flat. The facets must outlive the surface.
  SmoothSurface(std::span<const Facet> facets, const SmoothSides& smooth, double negligible);

  // Null for a flat facet.
  const CurvedFacet* curved(int facet) const {
    return index_[facet] < 0 ? nullptr : &curved_[static_cast<std::size_t>(index_[facet])];
  }
  const SmoothVertex& vertex(int i) const { return vertices_[static_cast<std::size_t>(i)]; }
  std::size_t curved_count() const { return curved_.size(); }

  // Distance of a vertex from the shadow boundary of a wave from `direction` (unit, towards its source) on the
  // illuminated side: sin(elevation over the surface) / kappa^(1/3), m^(1/3), kappa the normal curvature along the ray.
  // Zero where a facet of the vertex's fan faces away, infinite where the surface does not curve away. side: +1, or -1
  // for the back of a sheet.
  double shadow_boundary_distance(int vertex, const Vec3& direction, double side) const;

 private:
  std::vector<std::int32_t> index_;  // index into curved_; -1: flat
  std::vector<CurvedFacet> curved_;
  std::vector<SmoothVertex> vertices_;
  std::vector<std::int32_t> fan_;  // facets by vertex
  std::span<const Facet> facets_;
};

}  // namespace seaglint

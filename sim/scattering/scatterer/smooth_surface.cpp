// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/smooth_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/scattering/scatterer/smooth_vertices.h"

namespace seaglint {
namespace {

// B of dn = B dx on one facet, from the normals at its corners, 1/m.
Mat3 normal_derivative(const Facet& facet, const std::array<Vec3, 3>& normal) {
  const Vec3 e1 = facet.corner[1] - facet.corner[0], e2 = facet.corner[2] - facet.corner[0];
  const Vec3 across = e1.cross(e2);
  // Dual basis of e1, e2 in the facet's plane.
  const Vec3 d1 = e2.cross(across) / across.squaredNorm(), d2 = across.cross(e1) / across.squaredNorm();
  return outer_product(normal[1] - normal[0], d1) + outer_product(normal[2] - normal[0], d2);
}

}  // namespace

SmoothSurface::SmoothSurface(std::span<const Facet> facets, const SmoothSides& smooth, double negligible)
    : index_(facets.size(), -1), facets_(facets) {
  const int count = static_cast<int>(facets.size());
  SmoothVertices smooth_at = smooth_vertices(facets, smooth);
  fan_ = std::move(smooth_at.fan);
  vertices_.resize(smooth_at.normal.size());
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    vertices_[i].normal = smooth_at.normal[i];
    vertices_[i].first = smooth_at.first[i];
    vertices_[i].count = smooth_at.first[i + 1] - smooth_at.first[i];
  }

  std::vector<double> weights(vertices_.size(), 0);
  for (int f = 0; f < count; ++f) {
    const Facet& facet = facets[f];
    const std::array<std::int32_t, 3>& vertex = smooth_at.of_facet[f];
    CurvedFacet curved{vertex, {}};
    std::array<Vec3, 3> normal;
    for (int i = 0; i < 3; ++i) normal[i] = vertices_[vertex[i]].normal;
    double highest = 0;
    for (int i = 0; i < 3; ++i) {
      // Sagitta of an arc with chord e whose end normals differ by dn: dn . e / 8.
      const int j = (i + 1) % 3;
      curved.sagitta[i] = (normal[j] - normal[i]).dot(facet.corner[j] - facet.corner[i]) / 8;
      highest = std::max(highest, std::abs(curved.sagitta[i]));
    }
    if (highest > negligible) {
      index_[f] = static_cast<std::int32_t>(curved_.size());
      curved_.push_back(curved);
    }
    const Mat3 B = normal_derivative(facet, normal);
    for (int i = 0; i < 3; ++i) {
      const double vertex_weight = facet_weight(facet, i, smooth_at.facet_width[f], false);
      vertices_[vertex[i]].curvature += vertex_weight * 0.5 * (B + B.transpose());
      weights[vertex[i]] += vertex_weight;
    }
  }
  for (std::size_t i = 0; i < vertices_.size(); ++i) vertices_[i].curvature /= weights[i];
  curved_.shrink_to_fit();
}

double SmoothSurface::shadow_boundary_distance(int vertex, const Vec3& direction, double side) const {
  const SmoothVertex& v = vertices_[static_cast<std::size_t>(vertex)];
  double lowest = side * v.normal.dot(direction);
  for (std::int32_t i = v.first; i < v.first + v.count; ++i)
    lowest = std::min(lowest, side * facets_[fan_[i]].normal.dot(direction));
  if (lowest <= 0) return 0;
  const Vec3 along = direction - v.normal * v.normal.dot(direction);
  const double kappa = side * along.dot(v.curvature * along) / std::max(along.squaredNorm(), 1e-12);
  return kappa > 0 ? lowest / std::cbrt(kappa) : std::numeric_limits<double>::infinity();
}

}  // namespace seaglint

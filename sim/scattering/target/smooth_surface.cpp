// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/target/smooth_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seaglint {
namespace {

struct FacetCorner {
  std::int32_t facet = 0;
  std::int8_t corner = 0;
};

// Index of the facet's corner at this position, or -1.
int corner_at(const Facet& facet, const Vec3& position) {
  for (int i = 0; i < 3; ++i) {
    if (facet.corner[i] == position) return i;
  }
  return -1;
}

// Facet that continues f smoothly across its side: the only neighbour there, of the same orientation, whose normal
// differs by less than the crease angle; else -1.
int smooth_neighbour(std::span<const Facet> facets, int f, int edge, double cos_crease) {
  const int g = facets[f].neighbour[edge];
  if (g < 0 || facets[f].normal.dot(facets[g].normal) < cos_crease) return -1;
  const int from = corner_at(facets[g], facets[f].corner[(edge + 1) % 3]);
  if (from < 0 || facets[g].corner[(from + 1) % 3] != facets[f].corner[edge]) return -1;
  return facets[g].neighbour[from] == f ? g : -1;
}

double width(const Facet& facet) {
  return (facet.corner[1] - facet.corner[0]).cross(facet.corner[2] - facet.corner[0]).norm() / facet.longest_edge;
}

// Weight of a facet in a vertex normal. Facets of similar width: sin(angle) / (product of the two sides), exact on a
// sphere for any triangulation (N. Max, Journal of Graphics Tools 4 (1999) 1-6). Otherwise angle times width, which
// keeps a large flat face next to the narrow strips of a fillet flat to within their sagitta. Neither depends on the
// triangulation of a flat face.
double weight(const Facet& facet, int corner, bool alike) {
  const Vec3 a = facet.corner[(corner + 1) % 3] - facet.corner[corner],
             b = facet.corner[(corner + 2) % 3] - facet.corner[corner];
  const double twice_area = a.cross(b).norm();
  return alike ? twice_area / (a.squaredNorm() * b.squaredNorm()) : std::atan2(twice_area, a.dot(b)) * width(facet);
}

// Ratio of widths below which facets are of similar width.
constexpr double kAlike = 2;

// B of dn = B dx on one facet, from the normals at its corners, 1/m.
Mat3 normal_derivative(const Facet& facet, const std::array<Vec3, 3>& normal) {
  const Vec3 e1 = facet.corner[1] - facet.corner[0], e2 = facet.corner[2] - facet.corner[0];
  const Vec3 across = e1.cross(e2);
  // Dual basis of e1, e2 in the facet's plane.
  const Vec3 d1 = e2.cross(across) / across.squaredNorm(), d2 = across.cross(e1) / across.squaredNorm();
  return (normal[1] - normal[0]) * d1.transpose() + (normal[2] - normal[0]) * d2.transpose();
}

}  // namespace

SmoothSurface::SmoothSurface(std::span<const Facet> facets, double crease, double negligible)
    : index_(facets.size(), -1), facets_(facets) {
  const double cos_crease = std::cos(crease);
  const int count = static_cast<int>(facets.size());
  std::vector<std::array<std::int32_t, 3>> smooth(facets.size());
  for (int f = 0; f < count; ++f) {
    for (int e = 0; e < 3; ++e) smooth[f][e] = crease > 0 ? smooth_neighbour(facets, f, e, cos_crease) : -1;
  }

  // Fan of a corner: facets connected to it through smooth sides at its vertex.
  std::vector<std::array<std::int32_t, 3>> vertex_of(facets.size(), {-1, -1, -1});
  std::vector<FacetCorner> members;
  for (int f = 0; f < count; ++f) {
    for (int c = 0; c < 3; ++c) {
      if (vertex_of[f][c] >= 0) continue;
      SmoothVertex vertex;
      vertex.first = static_cast<std::int32_t>(members.size());
      const auto number = static_cast<std::int32_t>(vertices_.size());
      const Vec3 position = facets[f].corner[c];
      members.push_back({f, static_cast<std::int8_t>(c)});
      vertex_of[f][c] = number;
      for (std::size_t i = vertex.first; i < members.size(); ++i) {
        const auto [facet, corner] = members[i];
        for (const int edge : {static_cast<int>(corner), (corner + 2) % 3}) {
          const int g = smooth[facet][edge];
          const int there = g < 0 ? -1 : corner_at(facets[g], position);
          if (there < 0 || vertex_of[g][there] >= 0) continue;
          vertex_of[g][there] = number;
          members.push_back({g, static_cast<std::int8_t>(there)});
        }
      }
      vertex.count = static_cast<std::int32_t>(members.size()) - vertex.first;
      double narrowest = std::numeric_limits<double>::infinity(), widest = 0;
      for (std::size_t i = vertex.first; i < members.size(); ++i) {
        narrowest = std::min(narrowest, width(facets[members[i].facet]));
        widest = std::max(widest, width(facets[members[i].facet]));
      }
      const bool alike = widest < kAlike * narrowest;
      Vec3 sum = Vec3::Zero();
      for (std::size_t i = vertex.first; i < members.size(); ++i) {
        sum += weight(facets[members[i].facet], members[i].corner, alike) * facets[members[i].facet].normal;
      }
      vertex.normal = sum.normalized();
      vertices_.push_back(vertex);
    }
  }
  fan_.reserve(members.size());
  for (const FacetCorner& member : members) fan_.push_back(member.facet);

  std::vector<double> weights(vertices_.size(), 0);
  for (int f = 0; f < count; ++f) {
    const Facet& facet = facets[f];
    CurvedFacet curved{vertex_of[f], {}};
    std::array<Vec3, 3> normal;
    for (int i = 0; i < 3; ++i) normal[i] = vertices_[vertex_of[f][i]].normal;
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
      const double vertex_weight = weight(facet, i, false);
      vertices_[vertex_of[f][i]].curvature += vertex_weight * 0.5 * (B + B.transpose());
      weights[vertex_of[f][i]] += vertex_weight;
    }
  }
  for (std::size_t i = 0; i < vertices_.size(); ++i) vertices_[i].curvature /= weights[i];
  curved_.shrink_to_fit();
  vertices_.shrink_to_fit();
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

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/target/smooth_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "sim/core/numbers/smooth_step.h"
#include "sim/geometry/mesh/crease_normals.h"

namespace seaglint {
namespace {

struct FacetCorner {
  std::int32_t facet = 0;
  std::int8_t corner = 0;
};

// Width of every facet: that of its planar face, sqrt(12 times the least second moment of its area / area), the smaller
// side of a rectangle; of a facet of no known face, its height over the longest side.
std::vector<double> face_widths(std::span<const Facet> facets) {
  std::int32_t faces = 0;
  for (const Facet& facet : facets) faces = std::max(faces, facet.face + 1);
  std::vector<double> area(static_cast<std::size_t>(faces), 0);
  std::vector<Vec3> origin(area.size()), first(area.size(), Vec3::Zero());
  std::vector<Mat3> second(area.size(), Mat3::Zero());
  for (const Facet& facet : facets) {
    if (facet.face < 0) continue;
    const auto face = static_cast<std::size_t>(facet.face);
    if (area[face] == 0) origin[face] = facet.corner[0];
    const Vec3 a = facet.corner[0] - origin[face], b = facet.corner[1] - origin[face],
               c = facet.corner[2] - origin[face];
    const double own = 0.5 * (b - a).cross(c - a).norm();
    // Integral of x x^T over a triangle: area / 12 (sum of its corners' plus 9 times its centroid's).
    const Vec3 centre = (a + b + c) / 3;
    area[face] += own;
    first[face] += own * centre;
    second[face] +=
        own / 12 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + 9 * centre * centre.transpose());
  }
  std::vector<double> width(facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (facets[f].face < 0) {
      width[f] = (facets[f].corner[1] - facets[f].corner[0]).cross(facets[f].corner[2] - facets[f].corner[0]).norm() /
                 facets[f].longest_edge;
      continue;
    }
    const auto face = static_cast<std::size_t>(facets[f].face);
    const Vec3 mean = first[face] / area[face];
    const Mat3 about = second[face] / area[face] - mean * mean.transpose();
    // Moments in the plane: the two larger eigenvalues; the smallest belongs to the normal.
    width[f] = std::sqrt(12 * std::max(0.0, Eigen::SelfAdjointEigenSolver<Mat3>(about).eigenvalues()[1]));
  }
  return width;
}

double weight(const Facet& facet, int corner, double width, bool alike) {
  return corner_weight(facet.corner[(corner + 1) % 3] - facet.corner[corner],
                       facet.corner[(corner + 2) % 3] - facet.corner[corner], width, alike);
}

// Ratio of the largest to the smallest width up to which facets are of similar width, and from which they are not.
constexpr std::array<double, 2> kAlike{2, 3};

// B of dn = B dx on one facet, from the normals at its corners, 1/m.
Mat3 normal_derivative(const Facet& facet, const std::array<Vec3, 3>& normal) {
  const Vec3 e1 = facet.corner[1] - facet.corner[0], e2 = facet.corner[2] - facet.corner[0];
  const Vec3 across = e1.cross(e2);
  // Dual basis of e1, e2 in the facet's plane.
  const Vec3 d1 = e2.cross(across) / across.squaredNorm(), d2 = across.cross(e1) / across.squaredNorm();
  return (normal[1] - normal[0]) * d1.transpose() + (normal[2] - normal[0]) * d2.transpose();
}

}  // namespace

SmoothSurface::SmoothSurface(std::span<const Facet> facets, const SmoothSides& smooth, double negligible)
    : index_(facets.size(), -1), facets_(facets) {
  const int count = static_cast<int>(facets.size());
  const std::vector<double> width = face_widths(facets);

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
        narrowest = std::min(narrowest, width[members[i].facet]);
        widest = std::max(widest, width[members[i].facet]);
      }
      Vec3 of_alike = Vec3::Zero(), of_unlike = Vec3::Zero();
      for (std::size_t i = vertex.first; i < members.size(); ++i) {
        const auto [facet, corner] = members[i];
        of_alike += weight(facets[facet], corner, width[facet], true) * facets[facet].normal;
        of_unlike += weight(facets[facet], corner, width[facet], false) * facets[facet].normal;
      }
      const double alike = smooth_taper(widest / narrowest, kAlike);
      vertex.normal = (alike * of_alike.normalized() + (1 - alike) * of_unlike.normalized()).normalized();
      if (const Vec3& given = facets[f].corner_normal[c]; !given.isZero(0)) vertex.normal = given;
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
      const double vertex_weight = weight(facet, i, width[f], false);
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

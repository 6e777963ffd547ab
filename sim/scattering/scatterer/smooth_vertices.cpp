// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/smooth_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/core/numbers/principal_axes.h"
#include "sim/core/numbers/smooth_step.h"
#include "sim/geometry/mesh/crease_normals.h"
#include "sim/geometry/mesh/index_groups.h"

namespace seaglint {
namespace {

struct FacetCorner {
  std::int32_t facet = 0;
  std::int8_t corner = 0;
};

// Ratio of the largest to the smallest width up to which facets are of similar width, and from which they are not.
constexpr std::array<double, 2> kAlike{2, 3};

// Width of a planar face from the second moments of its area, m.
double face_width(std::span<const Facet> facets, std::span<const std::uint32_t> of_face) {
  const Vec3& origin = facets[of_face.front()].corner[0];
  double area = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const std::uint32_t f : of_face) {
    const Vec3 a = facets[f].corner[0] - origin, b = facets[f].corner[1] - origin, c = facets[f].corner[2] - origin;
    const double own = 0.5 * (b - a).cross(c - a).norm();
    // Integral of x x^T over a triangle: area / 12 (sum of its corners' plus 9 times its centroid's).
    const Vec3 centre = (a + b + c) / 3;
    area += own;
    first += own * centre;
    second += own / 12 *
              (outer_product(a, a) + outer_product(b, b) + outer_product(c, c) + outer_product(9 * centre, centre));
  }
  const Vec3 mean = first / area;
  const Mat3 about = second / area - outer_product(mean, mean);
  // Moments in the plane: the two larger eigenvalues; the smallest belongs to the normal.
  return std::sqrt(12 * std::max(0.0, principal_axes(about).values[1]));
}

std::vector<double> facet_widths(std::span<const Facet> facets) {
  std::int32_t faces = 0;
  for (const Facet& facet : facets) faces = std::max(faces, facet.face + 1);
  // The last group has the facets of no known face.
  const IndexGroups by_face(facets.size(), static_cast<std::size_t>(faces) + 1, [&](std::uint32_t f) {
    return static_cast<std::size_t>(facets[f].face < 0 ? faces : facets[f].face);
  });
  std::vector<double> width(facets.size());
  for (std::size_t face = 0; face + 1 < by_face.size(); ++face) {
    if (by_face[face].empty()) continue;
    const double of_face = face_width(facets, by_face[face]);
    for (const std::uint32_t f : by_face[face]) width[f] = of_face;
  }
  for (const std::uint32_t f : by_face[by_face.size() - 1]) {
    const auto& [a, b, c] = facets[f].corner;
    width[f] = (b - a).cross(c - a).norm() / facets[f].longest_edge;
  }
  return width;
}

// Mean of the facets' normals around a vertex.
Vec3 mean_normal(std::span<const Facet> facets, std::span<const FacetCorner> fan, std::span<const double> width) {
  double narrowest = std::numeric_limits<double>::infinity(), widest = 0;
  for (const FacetCorner& member : fan) {
    narrowest = std::min(narrowest, width[member.facet]);
    widest = std::max(widest, width[member.facet]);
  }
  const double alike = smooth_taper(widest / narrowest, kAlike);
  Vec3 mean = Vec3::Zero();
  for (const auto& [share, are_alike] : {std::pair(alike, true), std::pair(1 - alike, false)}) {
    if (share == 0) continue;
    Vec3 sum = Vec3::Zero();
    for (const auto& [facet, corner] : fan)
      sum += facet_weight(facets[facet], corner, width[facet], are_alike) * facets[facet].normal;
    mean += share * sum.normalized();
  }
  return mean.normalized();
}

}  // namespace

double facet_weight(const Facet& facet, int corner, double width, bool alike) {
  return corner_weight(facet.corner[(corner + 1) % 3] - facet.corner[corner],
                       facet.corner[(corner + 2) % 3] - facet.corner[corner], width, alike);
}

SmoothVertices smooth_vertices(std::span<const Facet> facets, const SmoothSides& smooth) {
  SmoothVertices vertices;
  vertices.of_facet.assign(facets.size(), {-1, -1, -1});
  vertices.facet_width = facet_widths(facets);
  vertices.fan.reserve(3 * facets.size());
  std::vector<FacetCorner> fan;
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    for (int c = 0; c < 3; ++c) {
      if (vertices.of_facet[f][c] >= 0) continue;
      // Facets connected to the corner through smooth sides at its vertex.
      const auto number = static_cast<std::int32_t>(vertices.normal.size());
      const Vec3 position = facets[f].corner[c];
      fan.assign(1, {f, static_cast<std::int8_t>(c)});
      vertices.of_facet[f][c] = number;
      for (std::size_t i = 0; i < fan.size(); ++i) {
        const auto [facet, corner] = fan[i];
        for (const int edge : {static_cast<int>(corner), (corner + 2) % 3}) {
          const int g = smooth[facet][edge];
          const int there = g < 0 ? -1 : corner_at(facets[g], position);
          if (there < 0 || vertices.of_facet[g][there] >= 0) continue;
          vertices.of_facet[g][there] = number;
          fan.push_back({g, static_cast<std::int8_t>(there)});
        }
      }
      const Vec3& given = facets[f].corner_normal[c];
      vertices.normal.push_back(given.isZero(0) ? mean_normal(facets, fan, vertices.facet_width) : given);
      vertices.first.push_back(static_cast<std::int32_t>(vertices.fan.size()));
      for (const FacetCorner& member : fan) vertices.fan.push_back(member.facet);
    }
  }
  vertices.first.push_back(static_cast<std::int32_t>(vertices.fan.size()));
  return vertices;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/surface/smooth_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/core/numbers/linear.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/surface/facets.h"

namespace seaglint {

namespace {

// On a line square to a side, as fractions of the turn at the side: the turn at the end of the flat strip next to it,
// the least turn that continues it, and the largest one.
constexpr double kStripTurn = 0.05, kLeastTurn = 0.6, kLargestTurn = 2;
// Length of the line in widths of that flat strip.
constexpr double kReach = 2.5;
// Fraction of the turn around two facets, at sides whose turn continues, from which their common side is smooth.
constexpr double kMajority = 0.7;
// Largest turn of a side that does not itself continue, relative to the mean of those nearby that do.
constexpr double kAlikeTurn = 3;

// Side of the facet across a side, if that is the only one there, of the same orientation, and turns by less than the
// crease angle; else -1.
int smooth_side(std::span<const Facet> facets, int f, int edge, double cos_crease) {
  const int g = facets[f].neighbour[edge];
  if (g < 0 || facets[f].normal.dot(facets[g].normal) < cos_crease) return -1;
  const int from = corner_at(facets[g], facets[f].corner[(edge + 1) % 3]);
  if (from < 0 || facets[g].corner[(from + 1) % 3] != facets[f].corner[edge]) return -1;
  return facets[g].neighbour[from] == f ? from : -1;
}

class ShapeTest {
 public:
  ShapeTest(std::span<const Facet> facets, const SmoothSides& candidates)
      : facets_(facets),
        candidates_(candidates),
        length_(facets.size()),
        turn_(facets.size(), {0, 0, 0}),
        continues_(facets.size(), {false, false, false}) {
    for (int f = 0; f < size(); ++f) {
      for (int e = 0; e < 3; ++e) length_[f][e] = (facets[f].corner[(e + 1) % 3] - facets[f].corner[e]).norm();
    }
    // Both facets of a side have the same values there.
    for (int f = 0; f < size(); ++f) {
      for (int e = 0; e < 3; ++e) {
        const int g = candidates[f][e];
        if (g > f) turn_[f][e] = turn_[g][side_towards(g, f)] = turn(f, e);
      }
    }
    for (int f = 0; f < size(); ++f) {
      for (int e = 0; e < 3; ++e) {
        const int g = candidates[f][e];
        if (g < f || turn_[f][e] == 0) continue;
        const int back = side_towards(g, f);
        continues_[f][e] = continues_[g][back] = turn_continues(f, e) || turn_continues(g, back);
      }
    }
  }

  SmoothSides run() const {
    std::vector<Neighbourhood> around(facets_.size());
    std::vector<int> fan;
    for (int f = 0; f < size(); ++f) {
      find_fan(f, fan);
      around[f] = neighbourhood(fan);
    }
    SmoothSides smooth = candidates_;
    for (int f = 0; f < size(); ++f) {
      for (int e = 0; e < 3; ++e) {
        const int g = candidates_[f][e];
        if (g < 0) continue;
        if (turn_[f][e] == 0) continue;  // inside a planar face
        const double fraction = std::max(around[f].fraction(), around[g].fraction());
        const double mean = std::max(around[f].mean_turn(), around[g].mean_turn());
        if (fraction < kMajority || (!continues_[f][e] && std::abs(turn_[f][e]) > kAlikeTurn * mean)) smooth[f][e] = -1;
      }
    }
    return smooth;
  }

 private:
  // Sums over the candidate sides of some facets, each weighted by its length.
  struct Neighbourhood {
    double turn = 0, continuing_turn = 0, continuing_length = 0;
    double fraction() const { return turn > 0 ? continuing_turn / turn : 0; }
    double mean_turn() const { return continuing_length > 0 ? continuing_turn / continuing_length : 0; }
  };

  int size() const { return static_cast<int>(facets_.size()); }

  int side_towards(int g, int f) const {
    for (int e = 0; e < 3; ++e) {
      if (candidates_[g][e] == f) return e;
    }
    return 0;
  }

  // Angle between the normals on both sides, convex > 0, rad; 0 within a planar face.
  double turn(int f, int e) const {
    const Facet &here = facets_[f], &there = facets_[candidates_[f][e]];
    if (here.face >= 0 && here.face == there.face) return 0;
    const Vec3 along = (here.corner[(e + 1) % 3] - here.corner[e]) / length_[f][e];
    return std::atan2(here.normal.cross(there.normal).dot(along), here.normal.dot(there.normal));
  }

  // The line starts at the middle of a side and runs over the facet and on, square to the side on the unfolded surface.
  // True where the turn at the side continues: within kReach widths of the flat strip next to it the sum of further
  // turns along the line reaches kLeastTurn of it with its sign, and at most kLargestTurn of it.
  bool turn_continues(int f, int e) const {
    const double start = turn_[f][e];
    Vec3 at = 0.5 * (facets_[f].corner[e] + facets_[f].corner[(e + 1) % 3]);
    Vec3 direction = facets_[f].normal.cross(facets_[f].corner[(e + 1) % 3] - facets_[f].corner[e]).normalized();
    double length = 0, sum = 0, reach = std::numeric_limits<double>::infinity();
    int entry = e;
    constexpr int kMaxSteps = 1000;
    for (int step = 0; step < kMaxSteps; ++step) {
      int exit = -1;
      double nearest = std::numeric_limits<double>::infinity();
      for (int i = 0; i < 3; ++i) {
        if (i == entry) continue;
        const Vec3 &a = facets_[f].corner[i], outward = (facets_[f].corner[(i + 1) % 3] - a).cross(facets_[f].normal);
        const double rate = direction.dot(outward);
        if (rate <= 0) continue;
        const double to_side = std::max(0.0, (a - at).dot(outward) / rate);
        if (to_side < nearest) {
          nearest = to_side;
          exit = i;
        }
      }
      if (exit < 0) return false;
      length += nearest;
      const int g = candidates_[f][exit];
      if (length > reach || g < 0) return false;
      at += nearest * direction;
      const Vec3 normal = facets_[f].normal;
      // Of the turn, its part about the axis square to the line counts.
      const Vec3 along = (facets_[f].corner[(exit + 1) % 3] - facets_[f].corner[exit]) / length_[f][exit];
      sum += turn_[f][exit] * std::abs(along.cross(direction).dot(normal));
      direction = rotation_between(normal, facets_[g].normal) * direction;
      if (std::abs(sum) > kStripTurn * std::abs(start)) reach = std::min(reach, kReach * length);
      if (std::abs(sum) >= kLeastTurn * std::abs(start))
        return sum * start > 0 && std::abs(sum) <= kLargestTurn * std::abs(start);
      entry = side_towards(g, f);
      f = g;
    }
    return false;
  }

  // A facet and those that share a corner with it by candidate sides.
  void find_fan(int f, std::vector<int>& fan) const {
    fan.assign(1, f);
    for (int corner = 0; corner < 3; ++corner) {
      // Around the corner, by the sides that start there and, unless that is a full turn, by those that end there.
      for (const int first : {corner, (corner + 2) % 3}) {
        int from = f, next = candidates_[f][first];
        while (next >= 0 && next != f) {
          if (std::ranges::find(fan, next) == fan.end()) fan.push_back(next);
          const int on = (side_towards(next, from) + (first == corner ? 1 : 2)) % 3;
          from = std::exchange(next, candidates_[next][on]);
        }
        if (next == f) break;
      }
    }
  }

  Neighbourhood neighbourhood(std::span<const int> fan) const {
    Neighbourhood sum;
    for (const int g : fan) {
      for (int e = 0; e < 3; ++e) {
        const double length = length_[g][e];
        sum.turn += length * std::abs(turn_[g][e]);
        if (!continues_[g][e]) continue;
        sum.continuing_turn += length * std::abs(turn_[g][e]);
        sum.continuing_length += length;
      }
    }
    return sum;
  }

  std::span<const Facet> facets_;
  const SmoothSides& candidates_;
  // By facet and side.
  std::vector<std::array<double, 3>> length_, turn_;
  std::vector<std::array<bool, 3>> continues_;
};

}  // namespace

SmoothSides smooth_sides_by_angle(std::span<const Facet> facets, double crease) {
  SmoothSides sides(facets.size(), {-1, -1, -1});
  if (crease <= 0) return sides;
  const double cos_crease = std::cos(crease);
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    for (int e = 0; e < 3; ++e) {
      const int g = facets[f].neighbour[e], back = g < f ? -1 : smooth_side(facets, f, e, cos_crease);
      if (back < 0) continue;
      sides[f][e] = g;
      sides[g][back] = f;
    }
  }
  return sides;
}

SmoothSides smooth_sides_by_shape(std::span<const Facet> facets, double crease) {
  const SmoothSides candidates = smooth_sides_by_angle(facets, crease);
  return ShapeTest(facets, candidates).run();
}

SmoothSides smooth_sides_by_normals(std::span<const Facet> facets) {
  constexpr double kAgree = 0.01;  // rad
  SmoothSides sides = smooth_sides_by_angle(facets, 2 * kMaxNormalDeviation);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t e = 0; e < 3; ++e) {
      if (sides[f][e] < 0) continue;
      const Facet &here = facets[f], &there = facets[static_cast<std::size_t>(sides[f][e])];
      for (const std::size_t corner : {e, (e + 1) % 3}) {
        const int other = corner_at(there, here.corner[corner]);
        const Vec3 &a = here.corner_normal[corner], &b = there.corner_normal[static_cast<std::size_t>(other)];
        if (a.isZero(0) || b.isZero(0) || (a - b).norm() > kAgree) sides[f][e] = -1;
      }
    }
  }
  return sides;
}

bool normals_describe_surface(const TriangleMesh& mesh) {
  constexpr double kShaded = 0.01;  // of the area
  double off = 0, far = 0, all = 0;
  for (std::size_t t = 0; t < mesh.corner_normals.size(); ++t) {
    const double area = area_vector(mesh, t).norm(), deviation = normal_deviation(mesh, t);
    all += area;
    if (deviation > kNormalDigits) off += area;
    if (deviation > kMaxNormalDeviation) far += area;
  }
  return off > 0 && far <= kShaded * all;
}

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

namespace {

struct FacetCorner {
  std::int32_t facet = 0;
  std::int8_t corner = 0;
};

// Ratio of the largest to the smallest width up to which facets are of similar width, and from which they are not.
constexpr std::array<double, 2> kAlikeSides{2, 3};

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
  const double alike = smooth_taper(widest / narrowest, kAlikeSides);
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

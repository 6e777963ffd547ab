// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/target/smooth_sides.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "sim/core/numbers/linear.h"

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

// Facet across the side, if it is the only one there, of the same orientation, and turns by less than the crease angle;
// else -1.
int smooth_neighbour(std::span<const Facet> facets, int f, int edge, double cos_crease) {
  const int g = facets[f].neighbour[edge];
  if (g < 0 || facets[f].normal.dot(facets[g].normal) < cos_crease) return -1;
  const int from = corner_at(facets[g], facets[f].corner[(edge + 1) % 3]);
  if (from < 0 || facets[g].corner[(from + 1) % 3] != facets[f].corner[edge]) return -1;
  return facets[g].neighbour[from] == f ? g : -1;
}

class ShapeTest {
 public:
  ShapeTest(std::span<const Facet> facets, const SmoothSides& candidates)
      : facets_(facets), candidates_(candidates), turn_(facets.size()), continues_(facets.size()) {
    for (int f = 0; f < size(); ++f) {
      for (int e = 0; e < 3; ++e) turn_[f][e] = candidates[f][e] < 0 ? 0 : turn(f, e);
    }
    for (int f = 0; f < size(); ++f) {
      for (int e = 0; e < 3; ++e) {
        const int g = candidates[f][e];
        if (g < 0 || turn_[f][e] == 0) continue;
        continues_[f][e] = turn_continues(f, e) || turn_continues(g, side_towards(g, f));
      }
    }
  }

  SmoothSides run() const {
    std::vector<Neighbourhood> around(facets_.size());
    for (int f = 0; f < size(); ++f) around[f] = neighbourhood(f);
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
    const Vec3 along = (here.corner[(e + 1) % 3] - here.corner[e]).normalized();
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
      const Vec3 along = (facets_[f].corner[(exit + 1) % 3] - facets_[f].corner[exit]).normalized();
      sum += turn_[f][exit] * std::abs(along.cross(direction).dot(normal));
      direction = Eigen::Quaterniond::FromTwoVectors(normal, facets_[g].normal) * direction;
      if (std::abs(sum) > kStripTurn * std::abs(start)) reach = std::min(reach, kReach * length);
      if (std::abs(sum) >= kLeastTurn * std::abs(start))
        return sum * start > 0 && std::abs(sum) <= kLargestTurn * std::abs(start);
      entry = side_towards(g, f);
      f = g;
    }
    return false;
  }

  // Sides of a facet and of those that share a corner with it by candidate sides.
  Neighbourhood neighbourhood(int f) const {
    std::vector<int> fan{f};
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3& x = facets_[f].corner[corner];
      for (const int first : {corner, (corner + 2) % 3}) {
        int from = f;
        for (int next = candidates_[f][first]; next >= 0 && next != f;) {
          if (std::ranges::find(fan, next) == fan.end()) fan.push_back(next);
          const int here = corner_at(facets_[next], x);
          if (here < 0) break;
          const int back = side_towards(next, from), on = back == here ? (here + 2) % 3 : here;
          from = next;
          next = candidates_[next][on];
        }
      }
    }
    Neighbourhood sum;
    for (const int g : fan) {
      for (int e = 0; e < 3; ++e) {
        const double length = (facets_[g].corner[(e + 1) % 3] - facets_[g].corner[e]).norm();
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
  std::vector<std::array<double, 3>> turn_;
  std::vector<std::array<bool, 3>> continues_;
};

}  // namespace

SmoothSides smooth_sides_by_angle(std::span<const Facet> facets, double crease) {
  SmoothSides sides(facets.size(), {-1, -1, -1});
  if (crease <= 0) return sides;
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    for (int e = 0; e < 3; ++e) sides[f][e] = smooth_neighbour(facets, f, e, std::cos(crease));
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

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/smooth_sides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/core/numbers/linear.h"
#include "sim/core/numbers/rotation.h"

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

}  // namespace seaglint

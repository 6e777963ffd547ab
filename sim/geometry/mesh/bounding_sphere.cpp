// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/bounding_sphere.h"

#include <Eigen/LU>
#include <algorithm>
#include <optional>
#include <vector>

namespace seaglint {
namespace {

constexpr double kOutside = 1e-12;  // of the radius: rounding of a distance
constexpr int kMaxSteps = 1000;     // the radius grows at every step; a mesh needs about ten

// Smallest sphere through one to four points: its centre lies in their affine hull and is as far from each. Empty where
// they are linearly dependent.
std::optional<Sphere> sphere_through(std::span<const Vec3> points) {
  const auto sides = static_cast<Eigen::Index>(points.size()) - 1;
  if (sides == 0) return Sphere{points[0], 0};
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> side(3, sides);
  for (Eigen::Index i = 0; i < sides; ++i) {
    const Vec3 own = points[static_cast<std::size_t>(i) + 1] - points[0];
    side.col(i) << own.x(), own.y(), own.z();
  }
  // c = points[0] + side x with 2 side^T side x = |side|^2.
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> gram = 2 * side.transpose() * side;
  const Eigen::FullPivLU<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>> lu(gram);
  if (!lu.isInvertible()) return std::nullopt;
  const Eigen::Vector3d centre = side * lu.solve(gram.diagonal() / 2);
  const Vec3 from_first(centre.x(), centre.y(), centre.z());
  return Sphere{points[0] + from_first, from_first.norm()};
}

// Smallest sphere that contains two to five points, the last of them on it; `support` is reduced to the points that
// determine it.
Sphere sphere_about(std::vector<Vec3>& support) {
  const Vec3 last = support.back();
  Sphere best{last, -1};
  std::vector<Vec3> chosen, of_best{last};
  const unsigned others = static_cast<unsigned>(support.size()) - 1;
  for (unsigned subset = 0; subset < 1U << others; ++subset) {
    chosen = {last};
    for (unsigned i = 0; i < others; ++i) {
      if (subset >> i & 1U) chosen.push_back(support[i]);
    }
    if (chosen.size() > 4) continue;
    const std::optional<Sphere> sphere = sphere_through(chosen);
    if (!sphere || (best.radius >= 0 && sphere->radius >= best.radius)) continue;
    const auto inside = [&](const Vec3& p) { return (p - sphere->centre).norm() <= sphere->radius * (1 + kOutside); };
    if (!std::ranges::all_of(support, inside)) continue;
    best = *sphere;
    of_best = chosen;
  }
  support = of_best;
  return best;
}

}  // namespace

// Each step adds the farthest point to the support of the sphere (E. Welzl, Smallest enclosing disks, LNCS 555, 1991,
// 359-370; with the farthest point as pivot: B. Gaertner, Fast and robust smallest enclosing balls, LNCS 1643, 1999,
// 325-338).
Sphere bounding_sphere(std::span<const Vec3> points) {
  if (points.empty()) return {};
  // Positions relative to the first point keep their digits far from the origin.
  const Vec3 origin = points[0];
  std::vector<Vec3> support{Vec3::Zero()};
  Sphere sphere;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vec3* farthest = points.data();
    double distance2 = -1;
    for (const Vec3& p : points) {
      const double here = (p - origin - sphere.centre).squaredNorm();
      if (here > distance2) farthest = &p, distance2 = here;
    }
    if (std::sqrt(distance2) <= sphere.radius * (1 + kOutside)) break;
    support.push_back(*farthest - origin);
    const Sphere larger = sphere_about(support);
    if (!(larger.radius > sphere.radius)) break;
    sphere = larger;
  }
  return {origin + sphere.centre, sphere.radius};
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/geometry/mesh/bounding_sphere.h"
#include "sim/geometry/mesh/disjoint_sets.h"

namespace seaglint {
namespace {

// Distance from the centre of a surface's sphere within which a larger surface is of the same body, in its radii. The
// ship's brackets hang up to 1.6 radii from the walls that they belong to.
constexpr double kReach = 2;

// Number of the surface of every facet, in order of their first facets.
std::vector<std::int32_t> surfaces(std::span<const Facet> facets) {
  std::vector<std::pair<const Vec3*, std::uint32_t>> corners;
  corners.reserve(3 * facets.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    for (const Vec3& corner : facets[f].corner) corners.emplace_back(&corner, f);
  }
  std::ranges::sort(
      corners, [](const auto& a, const auto& b) { return std::ranges::lexicographical_compare(*a.first, *b.first); });
  DisjointSets sets(facets.size());
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (*corners[i].first == *corners[i - 1].first) sets.unite(corners[i].second, corners[i - 1].second);
  }
  std::vector<std::int32_t> number(facets.size(), -1), of_facet;
  std::int32_t count = 0;
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    std::int32_t& own = number[sets.find(f)];
    if (own < 0) own = count++;
    of_facet.push_back(own);
  }
  return of_facet;
}

struct Surface {
  Sphere sphere;
  bool open = false;
};

double distance_to_side(const Vec3& x, const Vec3& a, const Vec3& b) {
  const double fraction = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (x - a - fraction * (b - a)).norm();
}

double distance_to_panel(const Vec3& x, const BvhPanel& panel) {
  const std::span<const Vec3> outline = panel.outline();
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    inside = inside && panel.normal.cross(b - a).dot(x - a) >= 0;
    nearest = std::min(nearest, distance_to_side(x, a, b));
  }
  return inside ? std::abs(panel.normal.dot(x) - panel.offset) : nearest;
}

// Calls visit(panel) for every panel that reaches into the sphere.
template <typename Visit>
void panels_in(const Sphere& sphere, const PanelBvh& tree, const Visit& visit) {
  const auto from = [&](int axis) { return sphere.centre[axis] - sphere.radius; };
  const auto to = [&](int axis) { return sphere.centre[axis] + sphere.radius; };
  Prism box;
  box.along = box.normal = Vec3::UnitX();
  box.offset = from(0);
  box.across = {Vec3::UnitY(), Vec3::UnitZ()};
  box.lower = {from(1), from(2)};
  box.upper = {to(1), to(2)};
  box.wave = Vec3::Zero();  // no panel faces away
  tree.traverse(box, [&](const BvhPanel& panel) {
    if (distance_to_panel(sphere.centre, panel) <= sphere.radius) visit(panel);
    return to(0);
  });
}

}  // namespace

BodySizes body_sizes(std::span<const Facet> facets, const PanelBvh& tree) {
  BodySizes sizes{surfaces(facets), {}};
  const auto count = static_cast<std::size_t>(*std::ranges::max_element(sizes.surface_of) + 1);
  std::vector<std::vector<Vec3>> corners(count);
  std::vector<Surface> surface(count);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto own = static_cast<std::size_t>(sizes.surface_of[f]);
    corners[own].insert(corners[own].end(), facets[f].corner.begin(), facets[f].corner.end());
    surface[own].open = surface[own].open || facets[f].two_sided;
  }
  for (std::size_t i = 0; i < count; ++i) surface[i].sphere = bounding_sphere(corners[i]);

  // Surfaces of one kind are united with those that they reach; pairs of a closed and an open one are decided by size
  // afterwards.
  DisjointSets bodies(count);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> mixed;  // closed, open
  for (std::uint32_t own = 0; own < count; ++own) {
    panels_in({surface[own].sphere.centre, kReach * surface[own].sphere.radius}, tree, [&](const BvhPanel& panel) {
      const auto other = static_cast<std::uint32_t>(sizes.surface_of[static_cast<std::size_t>(panel.facet)]);
      if (other == own || surface[other].sphere.radius < surface[own].sphere.radius) return;
      if (surface[other].open == surface[own].open) {
        bodies.unite(own, other);
      } else {
        const auto pair = surface[own].open ? std::pair{other, own} : std::pair{own, other};
        if (mixed.empty() || mixed.back() != pair) mixed.push_back(pair);
      }
    });
  }
  const auto largest = [&](DisjointSets& sets) {
    std::vector<double> radius(count, 0);  // by representative
    for (std::uint32_t i = 0; i < count; ++i)
      radius[sets.find(i)] = std::max(radius[sets.find(i)], surface[i].sphere.radius);
    return radius;
  };
  const std::vector<double> radius = largest(bodies);
  DisjointSets joined = bodies;
  for (const auto& [closed, open] : mixed) {
    if (radius[bodies.find(open)] <= radius[bodies.find(closed)]) joined.unite(open, closed);
  }
  const std::vector<double> of_body = largest(joined);
  for (std::uint32_t i = 0; i < count; ++i) sizes.radius.push_back(of_body[joined.find(i)]);
  return sizes;
}

}  // namespace seaglint

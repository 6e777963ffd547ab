// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/target/bodies.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/geometry/mesh/bounding_sphere.h"
#include "sim/geometry/mesh/disjoint_sets.h"

namespace seaglint {
namespace {

// Distance at which surfaces meet, of the target's radius: coordinates in single precision.
constexpr double kGap = 1e-6;

// Unites facets that have a vertex in common.
DisjointSets surfaces_of(std::span<const Facet> facets) {
  std::vector<std::pair<const Vec3*, std::uint32_t>> corners;
  corners.reserve(3 * facets.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    for (const Vec3& corner : facets[f].corner) corners.emplace_back(&corner, f);
  }
  std::ranges::sort(corners, [](const auto& a, const auto& b) {
    return std::ranges::lexicographical_compare(*a.first, *b.first);
  });
  DisjointSets sets(facets.size());
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (*corners[i].first == *corners[i - 1].first) sets.unite(corners[i].second, corners[i - 1].second);
  }
  return sets;
}

// True where the segment from a to b meets the panel to within `gap`, m.
bool meets(const Vec3& a, const Vec3& b, const BvhPanel& panel, double gap) {
  const double at_a = panel.normal.dot(a) - panel.offset, at_b = panel.normal.dot(b) - panel.offset;
  if (std::min(at_a, at_b) > gap || std::max(at_a, at_b) < -gap) return false;
  const double fraction = at_a == at_b ? 0 : std::clamp(at_a / (at_a - at_b), 0.0, 1.0);
  const Vec3 x = a + fraction * (b - a);
  const std::span<const Vec3> outline = panel.outline();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 side = outline[(i + 1) % outline.size()] - outline[i];
    if (panel.normal.cross(side).dot(x - outline[i]) < -gap * side.norm()) return false;
  }
  return true;
}

// Panels that may meet the segment, as a prism without width.
Prism prism_about(const Vec3& a, const Vec3& b, double gap) {
  Prism prism;
  prism.along = prism.normal = (b - a).normalized();
  prism.offset = prism.normal.dot(a) - gap;
  prism.across[0] = prism.along.unitOrthogonal();
  prism.across[1] = prism.along.cross(prism.across[0]);
  for (int i = 0; i < 2; ++i) {
    prism.lower[i] = prism.across[i].dot(a) - gap;
    prism.upper[i] = prism.across[i].dot(a) + gap;
  }
  prism.wave = Vec3::Zero();  // no panel faces away
  return prism;
}

std::vector<double> radii(std::span<const Facet> facets, std::span<const std::uint32_t> root) {
  std::vector<std::vector<Vec3>> points(facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f)
    points[root[f]].insert(points[root[f]].end(), facets[f].corner.begin(), facets[f].corner.end());
  std::vector<double> radius(facets.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) radius[i] = bounding_sphere(points[i]).radius;
  return radius;
}

std::vector<std::uint32_t> roots(DisjointSets& sets, std::size_t count) {
  std::vector<std::uint32_t> root(count);
  for (std::uint32_t i = 0; i < count; ++i) root[i] = sets.find(i);
  return root;
}

}  // namespace

Bodies find_bodies(std::span<const Facet> facets, const PanelBvh& tree, double radius) {
  DisjointSets surfaces = surfaces_of(facets);
  const std::vector<std::uint32_t> surface = roots(surfaces, facets.size());
  std::vector<char> open(facets.size(), 0);  // by root
  for (std::size_t f = 0; f < facets.size(); ++f) open[surface[f]] |= static_cast<char>(facets[f].two_sided);

  // Surfaces meet where a side of a facet of one meets a panel of the other. Those that are alike are united; pairs of
  // a closed and an open one wait.
  DisjointSets bodies = surfaces;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> mixed;
  const double gap = kGap * radius;
  const bool one_surface = std::ranges::all_of(surface, [&](std::uint32_t root) { return root == surface[0]; });
  for (std::uint32_t f = 0; f < facets.size() && !one_surface; ++f) {
    for (int i = 0; i < 3; ++i) {
      if (facets[f].neighbour[i] > static_cast<std::int32_t>(f)) continue;  // the side of that facet
      const Vec3 &a = facets[f].corner[i], &b = facets[f].corner[(i + 1) % 3];
      const Prism prism = prism_about(a, b, gap);
      const double end = prism.along.dot(b) + gap;
      tree.traverse(prism, [&](const BvhPanel& panel) {
        const std::uint32_t own = surface[f], other = surface[static_cast<std::size_t>(panel.facet)];
        if (own == other || bodies.find(own) == bodies.find(other)) return end;
        const auto pair = open[own] != 0 ? std::pair{other, own} : std::pair{own, other};  // closed, open
        const bool alike = open[own] == open[other];
        if ((!alike && !mixed.empty() && mixed.back() == pair) || !meets(a, b, panel, gap)) return end;
        if (alike) bodies.unite(own, other);
        if (!alike) mixed.push_back(pair);
        return end;
      });
    }
  }
  const std::vector<double> size = radii(facets, roots(bodies, facets.size()));
  DisjointSets joined = bodies;
  for (const auto& [closed, sheet] : mixed) {
    if (size[bodies.find(sheet)] <= size[bodies.find(closed)]) joined.unite(sheet, closed);
  }

  const std::vector<std::uint32_t> root = roots(joined, facets.size());
  const std::vector<double> of_root = radii(facets, root);
  Bodies result;
  std::vector<std::int32_t> number(facets.size(), -1);
  for (const std::uint32_t r : root) {
    if (number[r] < 0) {
      number[r] = static_cast<std::int32_t>(result.radius.size());
      result.radius.push_back(of_root[r]);
    }
    result.of_facet.push_back(number[r]);
  }
  return result;
}

}  // namespace seaglint

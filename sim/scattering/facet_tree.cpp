// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/facet_tree.h"

#include <algorithm>
#include <cmath>

namespace seaglint {
namespace {

struct Extent {
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 upper = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec3& x) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  void add(const Extent& other) {
    lower = lower.cwiseMin(other.lower);
    upper = upper.cwiseMax(other.upper);
  }
  double half_surface() const {
    const Vec3 size = upper - lower;
    return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
  }
};

Extent extent_of(std::span<const Vec3> corners) {
  Extent extent;
  for (const Vec3& x : corners) extent.add(x);
  return extent;
}

}  // namespace

struct FacetTree::Builder {
  static constexpr int kLevelsBySlices = 48;

  std::span<const Facet> facets;
  std::vector<Node>& nodes;
  std::vector<Leaf>& leaves;
  std::vector<Extent> bounds;  // of each facet
  std::vector<int> order;      // facets; every node owns a range of it

  struct Range {
    std::size_t first, last;
    Extent bounds;

    std::size_t size() const { return last - first; }
  };

  Range range(std::size_t first, std::size_t last) const {
    Range result{first, last, {}};
    for (std::size_t i = first; i < last; ++i) result.bounds.add(bounds[order[i]]);
    return result;
  }

  // Where to part a range: the surface area heuristic over 16 slices of each axis of the facets' centres (I. Wald, On fast construction of SAH-based
  // bounding volume hierarchies, RT 2007); in the middle where all centres coincide.
  std::pair<Range, Range> parted(const Range& whole, bool by_slices) {
    constexpr int kSlices = 16;
    Extent centres;
    for (std::size_t i = whole.first; i < whole.last; ++i) centres.add(bounds[order[i]].lower + bounds[order[i]].upper);
    const auto slice_of = [&](int facet, int axis) {
      const double x = bounds[facet].lower[axis] + bounds[facet].upper[axis] - centres.lower[axis];
      return std::min(kSlices - 1, static_cast<int>(kSlices * x / (centres.upper[axis] - centres.lower[axis])));
    };
    int best_axis = -1, best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; by_slices && axis < 3; ++axis) {
      if (!(centres.upper[axis] > centres.lower[axis])) continue;
      std::array<Extent, kSlices> slice;
      std::array<std::size_t, kSlices> count{};
      for (std::size_t i = whole.first; i < whole.last; ++i) {
        const int s = slice_of(order[i], axis);
        slice[s].add(bounds[order[i]]);
        ++count[s];
      }
      std::array<double, kSlices> above{};  // cost of all slices after this one
      Extent sweep;
      std::size_t swept = 0;
      for (int s = kSlices - 1; s > 0; --s) {
        if (count[s] > 0) sweep.add(slice[s]);
        swept += count[s];
        above[s - 1] = swept > 0 ? sweep.half_surface() * static_cast<double>(swept) : 0;
      }
      sweep = {};
      swept = 0;
      for (int s = 0; s + 1 < kSlices; ++s) {
        if (count[s] > 0) sweep.add(slice[s]);
        swept += count[s];
        if (swept == 0 || swept == whole.size()) continue;
        const double cost = sweep.half_surface() * static_cast<double>(swept) + above[s];
        if (cost < least) {
          least = cost;
          best_axis = axis;
          best = s;
        }
      }
    }
    std::size_t middle = whole.first + whole.size() / 2;
    if (best_axis >= 0) {
      const auto split = std::stable_partition(order.begin() + whole.first, order.begin() + whole.last,
                                               [&](int facet) { return slice_of(facet, best_axis) <= best; });
      middle = static_cast<std::size_t>(split - order.begin());
    }
    return {range(whole.first, middle), range(middle, whole.last)};
  }

  static double weight(const Range& range) { return range.size() < 2 ? -1 : range.bounds.half_surface(); }

  std::int32_t leaf(int facet) {
    const Vec3 normal = facets[facet].open ? Vec3(Vec3::Zero()) : facets[facet].normal;
    leaves.push_back({{static_cast<float>(normal.x()), static_cast<float>(normal.y()), static_cast<float>(normal.z())}, facet});
    return -static_cast<std::int32_t>(leaves.size());
  }

  // Facets below the depth where slices may still part them are parted in the middle, which ends within 32 levels more.
  std::int32_t build(const Range& whole, int depth) {
    // The child most likely to be met is parted until there are four.
    std::vector<Range> children{whole};
    while (children.size() < 4) {
      const auto largest = std::max_element(children.begin(), children.end(), [](const Range& a, const Range& b) { return weight(a) < weight(b); });
      if (largest->size() < 2) break;
      auto [low, high] = parted(*largest, depth < kLevelsBySlices);
      *largest = low;
      children.push_back(high);
    }
    const auto index = static_cast<std::int32_t>(nodes.size());
    nodes.emplace_back();
    Node node;
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const bool used = lane < children.size();
      for (int a = 0; a < 3; ++a) {
        node.centre[a][lane] = used ? static_cast<float>((children[lane].bounds.lower[a] + children[lane].bounds.upper[a]) / 2) : 0.0F;
        node.half[a][lane] = used ? static_cast<float>((children[lane].bounds.upper[a] - children[lane].bounds.lower[a]) / 2)
                                  : -1e30F;
      }
      node.child[lane] = !used ? -1 : children[lane].size() == 1 ? leaf(order[children[lane].first]) : build(children[lane], depth + 1);
    }
    nodes[index] = node;
    return index;
  }
};

FacetTree::FacetTree(std::span<const Facet> facets, const Panels& panels) {
  if (facets.empty()) return;
  Builder builder{facets, nodes_, leaves_, {}, {}};
  for (std::size_t f = 0; f < facets.size(); ++f) {
    builder.bounds.push_back(extent_of(panels.outline(static_cast<int>(f))));
    if (panels.is_first(static_cast<int>(f))) builder.order.push_back(static_cast<int>(f));
  }
  const auto whole = builder.range(0, builder.order.size());
  nodes_.reserve(builder.order.size() / 2 + 1);
  builder.build(whole, 0);
  // Centres, halves and the sums made of them are off by a few units in the last place of the largest coordinate, 6e-8 of it each.
  slack_ = 1e-6 * (whole.bounds.lower.norm() + whole.bounds.upper.norm());
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/facet_tree.h"

#include <algorithm>
#include <cmath>

#include "sim/scattering/embree_scene.h"

namespace seaglint {

FacetTree::FacetTree(std::span<const Facet> facets, const Panels& panels) {
  std::vector<Box3> boxes;
  std::vector<TreePanel> by_box;
  Box3 all;
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    if (!panels.is_first(f)) continue;
    Box3& box = boxes.emplace_back();
    for (const Vec3& corner : panels.outline(f)) {
      box.add(corner);
      all.add(corner);
    }
    const std::span<const Vec3> outline = panels.outline(f);
    by_box.push_back({facets[f].normal, outline.data(), f, static_cast<std::uint16_t>(outline.size()), facets[f].open});
  }
  for (const BoxNode& built : box_tree(boxes)) {
    Node node{};
    for (int lane = 0; lane < kMostChildren; ++lane) {
      const bool used = lane < built.children;
      const BoxNode::Child& child = built.child[lane];
      for (int a = 0; a < 3; ++a) {
        node.centre[a][lane] = used ? (child.lower[a] + child.upper[a]) / 2 : 0.0F;
        node.half[a][lane] = used ? (child.upper[a] - child.lower[a]) / 2 : -1e30F;
      }
      node.child[lane] = used ? child.index : -1;
      if (!used || child.index >= 0) continue;
      node.child[lane] = -1 - static_cast<std::int32_t>(panels_.size());
      const TreePanel& panel = panels_.emplace_back(by_box[-1 - child.index]);
      if (panel.open) continue;
      for (int a = 0; a < 3; ++a) node.normal[a][lane] = static_cast<float>(panel.normal[a]);
    }
    nodes_.push_back(node);
  }
  // Centres, halves and the sums made of them are off by a few units in the last place of the largest coordinate, 6e-8
  // of it each.
  if (!boxes.empty()) slack_ = 1e-6 * (all.lower.norm() + all.upper.norm());
}

}  // namespace seaglint

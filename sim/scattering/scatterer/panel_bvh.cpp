// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/panel_bvh.h"

#include <algorithm>
#include <cmath>

#include "sim/core/process/parallel.h"
#include "sim/scattering/scatterer/embree_scene.h"

namespace seaglint {
namespace {

// normal . wave above which a panel faces away, with a margin for single precision.
constexpr float kFacesAway = 1e-5F;

}  // namespace

BvhPanel bvh_panel(std::span<const Facet> facets, const Panels& panels, int facet) {
  const Facet& first = facets[facet];
  const std::span<const Vec3> outline = panels.outline(facet);
  return {first.normal,   first.offset, outline.data(), facet, static_cast<std::uint16_t>(outline.size()),
          first.two_sided};
}

PanelBvh::PanelBvh(std::span<const Facet> facets, const Panels& panels) {
  std::vector<Box3> boxes;
  std::vector<BvhPanel> by_box;
  Box3 all;
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    if (!panels.is_representative(f)) continue;
    Box3& box = boxes.emplace_back();
    for (const Vec3& corner : panels.outline(f)) {
      box.add(corner);
      all.add(corner);
    }
    by_box.push_back(bvh_panel(facets, panels, f));
  }
  for (const BvhNode& built : build_bvh(boxes)) {
    Node node{};
    for (int lane = 0; lane < kMaxChildren; ++lane) {
      const bool used = lane < built.children;
      const BvhNode::Child& child = built.child[lane];
      for (int a = 0; a < 3; ++a) {
        node.centre[a][lane] = used ? (child.lower[a] + child.upper[a]) / 2 : 0.0F;
        node.half[a][lane] = used ? (child.upper[a] - child.lower[a]) / 2 : -1e30F;
      }
      node.child[lane] = used ? child.index : -1;
      if (!used || child.index >= 0) continue;
      node.child[lane] = -1 - static_cast<std::int32_t>(panels_.size());
      const BvhPanel& panel = panels_.emplace_back(by_box[-1 - child.index]);
      if (panel.open) continue;
      for (int a = 0; a < 3; ++a) node.normal[a][lane] = static_cast<float>(panel.normal[a]);
    }
    nodes_.push_back(node);
  }
  // Rounding error of centres, half-widths and their sums: a few units in the last place, 6e-8 each, of the largest
  // coordinate.
  if (!boxes.empty()) slack_ = 1e-6 * (all.lower.norm() + all.upper.norm());
}

PanelBvh::SeparatingAxes PanelBvh::axes_of(const Prism& prism) const {
  const auto set_parts = [](auto& axis, const auto& x) {
    for (std::size_t a = 0; a < axis.part.size(); ++a) {
      axis.part[a] = static_cast<float>(x[static_cast<int>(a)]);
      axis.extent[a] = std::abs(axis.part[a]);
    }
  };
  const auto middle = [&](int i) { return (prism.lower[i] + prism.upper[i]) / 2; };
  const auto half = [&](int i) { return (prism.upper[i] - prism.lower[i]) / 2; };
  SeparatingAxes axes;
  for (int i = 0; i < 2; ++i) {
    set_parts(axes.side[i], prism.across[i]);
    axes.side[i].middle = static_cast<float>(middle(i));
    axes.side[i].width = static_cast<float>(half(i) + slack_);
  }
  for (int e = 0; e < 3; ++e) {
    Vec3 axis;
    axis[e] = 1;
    const Vec3 n = axis.cross(prism.along);
    const double first = n.dot(prism.across[0]), second = n.dot(prism.across[1]);
    set_parts(axes.edge[e], Vec2(n[(e + 1) % 3], n[(e + 2) % 3]));
    axes.edge[e].middle = static_cast<float>(first * middle(0) + second * middle(1));
    axes.edge[e].width = static_cast<float>(std::abs(first) * half(0) + std::abs(second) * half(1) + slack_);
  }
  set_parts(axes.normal, prism.normal);
  axes.normal.middle = static_cast<float>(prism.offset - slack_);
  set_parts(axes.along, prism.along);
  for (int a = 0; a < 3; ++a) axes.wave[a] = static_cast<float>(prism.wave[a]);
  return axes;
}

// Innermost loop of every traversal. All vector widths give the same bits (no contraction).
SEAGLINT_FUNCTION_VERSIONS("avx2", "default")
void PanelBvh::find_separations(const Node& node, const SeparatingAxes& axes, Separations& gaps) {
  Separations own;  // local, so that the compiler can vectorise over the lanes
  for (int lane = 0; lane < kMaxChildren; ++lane) {
    const auto larger = [](float a, float b) { return a > b ? a : b; };
    const auto at = [&](const SeparatingAxes::Axis<3>& axis) {
      return axis.part[0] * node.centre[0][lane] + axis.part[1] * node.centre[1][lane] +
             axis.part[2] * node.centre[2][lane];
    };
    const auto half = [&](const SeparatingAxes::Axis<3>& axis) {
      return axis.extent[0] * node.half[0][lane] + axis.extent[1] * node.half[1][lane] +
             axis.extent[2] * node.half[2][lane];
    };
    const auto side = [&](int i) {
      const SeparatingAxes::Axis<3>& axis = axes.side[i];
      return std::abs(at(axis) - axis.middle) - half(axis) - axis.width;
    };
    const auto edge = [&](int e) {
      const SeparatingAxes::Axis<2>& axis = axes.edge[e];
      const int a = (e + 1) % 3, b = (e + 2) % 3;
      const float centre = axis.part[0] * node.centre[a][lane] + axis.part[1] * node.centre[b][lane];
      return std::abs(centre - axis.middle) - axis.extent[0] * node.half[a][lane] -
             axis.extent[1] * node.half[b][lane] - axis.width;
    };
    const float behind = axes.normal.middle - at(axes.normal) - half(axes.normal);
    const float away = axes.wave[0] * node.normal[0][lane] + axes.wave[1] * node.normal[1][lane] +
                       axes.wave[2] * node.normal[2][lane] - kFacesAway;
    const float sides = larger(side(0), side(1)), edges = larger(larger(edge(0), edge(1)), edge(2));
    own.separation[lane] = larger(larger(sides, edges), larger(behind, away));
    own.entry_distance[lane] = at(axes.along) - half(axes.along);
  }
  gaps = own;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Bounding-volume hierarchy over the panels of a target, queried with the prism that a beam sweeps. The query is
// conservative: no panel in the prism is missed, of any size.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sim/scattering/scatterer/embree_scene.h"
#include "sim/scattering/scatterer/panels.h"

namespace seaglint {

// Prism of parallel rays beyond a plane: points with lower[i] <= across[i] . x <= upper[i] and normal . x >= offset;
// all axes are unit vectors, m. `along` is the direction in which distances are counted.
struct Prism {
  std::array<Vec3, 2> across;
  std::array<double, 2> lower{}, upper{};  // m
  Vec3 normal = Vec3::UnitX();
  double offset = 0;  // m
  Vec3 along = Vec3::UnitX();
  // direction of propagation: panels of closed surfaces with normal . wave > 0 face away and are left out
  Vec3 wave = Vec3::UnitX();
};

// Panel with the data that decide whether a beam overlaps it, contiguous in memory.
struct BvhPanel {
  Vec3 normal;                   // unit
  double offset = 0;             // plane normal . x = offset, m
  const Vec3* corner = nullptr;  // outline, counter-clockwise about the normal
  std::int32_t facet = -1;       // first facet of the panel
  std::uint16_t corners = 0;
  bool open = false;  // part of an open sheet: visible from either side

  std::span<const Vec3> outline() const { return {corner, corners}; }
};

// Panel with this first facet. Its outline refers to memory of facets and panels.
BvhPanel bvh_panel(std::span<const Facet> facets, const Panels& panels, int facet);

// Immutable after construction; queries are safe from any number of threads. Facets and panels must outlive it.
class PanelBvh {
 public:
  PanelBvh(std::span<const Facet> facets, const Panels& panels);

  // Calls visit(panel) for every panel that overlaps the prism and does not face away, and for some further ones (boxes
  // within rounding error of the prism, panels near edge-on), in an order that depends on tree and prism only. visit
  // returns the position along the prism, m, beyond which panels are no longer needed; panels that begin beyond it may
  // be left out.
  template <typename Visit>
  void traverse(const Prism& prism, const Visit& visit) const;

 private:
  // Boxes of all children by component, so that one vector instruction tests them together. A child below zero is panel
  // -1 - child.
  template <typename T>
  using PerChild = std::array<T, kMaxChildren>;
  struct alignas(64) Node {
    std::array<PerChild<float>, 3> centre, half;  // m; half < 0: unused child
    // normal of a one-sided panel; 0 for sheets and inner nodes
    std::array<PerChild<float>, 3> normal;
    PerChild<std::int32_t> child;
  };
  // Prism in single precision as separating axes (S. Gottschalk, M. C. Lin and D. Manocha, Proc. SIGGRAPH 1996,
  // 171-180): on each axis the prism covers middle +- width, a box its centre +- the sum of extent times half; disjoint
  // on one axis, they do not overlap. Axes: two sides of the prism and, projected along it, the edges of the box;
  // edge[e] is normal to coordinate axis e.
  struct SeparatingAxes {
    template <std::size_t kParts>
    struct Axis {
      std::array<float, kParts> part{}, extent{};  // |part|
      float middle = 0, width = 0;
    };
    std::array<Axis<3>, 2> side;
    std::array<Axis<2>, 3> edge;  // components along the coordinate axes after e
    Axis<3> normal, along;        // middle: position of the bounding plane; width unused
    std::array<float, 3> wave{};
  };
  SeparatingAxes axes_of(const Prism& prism) const;

  // Result of the overlap test for all children of a node.
  struct Separations {
    // Largest separation on an axis, or for a one-sided panel how far it faces away; above 0: no overlap.
    PerChild<float> separation;
    PerChild<float> entry_distance;  // nearest position of the box along the prism, m
  };
  static void find_separations(const Node& node, const SeparatingAxes& axes, Separations& gaps);

  // Subtree or leaf to be visited, and its nearest position along the prism.
  struct StackEntry {
    std::int32_t child;
    float entry_distance;
  };
  // Largest stack: all children but one of every level, and all of the deepest.
  static constexpr std::size_t kMaxStack = (kMaxChildren - 1) * kMaxLevels + kMaxChildren;
  std::vector<Node> nodes_;       // root first
  std::vector<BvhPanel> panels_;  // in the order of the leaves
  double slack_ = 0;              // rounding error of single-precision boxes, m
};

template <typename Visit>
void PanelBvh::traverse(const Prism& prism, const Visit& visit) const {
  if (nodes_.empty()) return;
  const SeparatingAxes axes = axes_of(prism);
  Separations gaps;
  float far = std::numeric_limits<float>::infinity();
  std::array<StackEntry, kMaxStack> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, -far};
  while (waiting > 0) {
    const StackEntry next = stack[--waiting];
    if (next.entry_distance > far) continue;
    if (next.child < 0) {
      far = static_cast<float>(visit(panels_[-1 - next.child]) + slack_);
      continue;
    }
    const Node& node = nodes_[next.child];
    find_separations(node, axes, gaps);
    // Every child is written to the top of the stack, which advances only where it overlaps the prism: no unpredictable
    // branch.
    for (int lane = 0; lane < kMaxChildren; ++lane) {
      stack[waiting] = {node.child[lane], gaps.entry_distance[lane]};
      waiting += gaps.separation[lane] <= 0;
    }
  }
}

}  // namespace seaglint

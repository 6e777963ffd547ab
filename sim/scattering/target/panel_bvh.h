// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Which panels may a beam meet? Embree's tree of boxes over the panels, asked with a prism instead of a ray: nothing is
// missed, however small.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sim/scattering/target/embree_scene.h"
#include "sim/scattering/target/panels.h"

namespace seaglint {

// A bundle of parallel rays from one side of a plane: the points with lower[i] <= across[i] . x <= upper[i] and normal
// . x >= offset, all axes unit vectors. It is walked along `along`.
struct Prism {
  std::array<Vec3, 2> across;
  std::array<double, 2> lower{}, upper{};  // m
  Vec3 normal = Vec3::UnitX();
  double offset = 0;  // m
  Vec3 along = Vec3::UnitX();
  // what it lights faces this way: panels of closed surfaces with normal . wave > 0 are left out
  Vec3 wave = Vec3::UnitX();
};

// A panel as a walk comes upon it: what decides whether a beam meets it, and where, side by side in memory.
struct BvhPanel {
  Vec3 normal;                   // unit
  double offset = 0;             // of its plane, normal . x = offset, m
  const Vec3* corner = nullptr;  // its outline, counter-clockwise seen against the normal
  std::int32_t facet = -1;       // the one it goes by
  std::uint16_t corners = 0;
  bool open = false;  // either side may be seen

  std::span<const Vec3> outline() const { return {corner, corners}; }
};

// The panel that goes by this facet. Its outline stays that of facets and panels.
BvhPanel bvh_panel(std::span<const Facet> facets, const Panels& panels, int facet);

// Immutable after construction; any number of threads may ask at once. Facets and panels must outlive it.
class PanelBvh {
 public:
  PanelBvh(std::span<const Facet> facets, const Panels& panels);

  // Calls visit(panel) for every panel that has a point in the prism and does not face away, and for some whose box
  // only comes near or that lie edge-on, in an order that depends on tree and prism alone. visit returns how far along
  // the prism panels still matter, m; those that begin beyond may be left out.
  template <typename Visit>
  void traverse(const Prism& prism, const Visit& visit) const;

 private:
  // Boxes side by side, so that the compiler compares them at once. A child below zero is panel -1 - child.
  template <typename T>
  using PerChild = std::array<T, kMaxChildren>;
  struct alignas(64) Node {
    std::array<PerChild<float>, 3> centre, half;  // m; half < 0: no box
    // of a panel seen from one side; 0 of all else, which no direction rules out
    std::array<PerChild<float>, 3> normal;
    PerChild<std::int32_t> child;
  };
  // A prism in single precision, as boxes are tested against it. Along each of these axes it covers middle +- width,
  // and a box its centre +- the sum of reach times half. Where they lie apart along one the two do not meet (separating
  // axes: S. Gottschalk, M. C. Lin and D. Manocha, Proc. SIGGRAPH 1996, 171-180): two sides of the prism and, seen
  // along it, the edges of the box, edge[e] having no part along axis e.
  struct SeparatingAxes {
    template <std::size_t kParts>
    struct Axis {
      std::array<float, kParts> part{}, extent{};  // |part|
      float middle = 0, width = 0;
    };
    std::array<Axis<3>, 2> side;
    std::array<Axis<2>, 3> edge;  // parts along the axes after e
    Axis<3> normal, along;        // middle: where the prism begins; width: none
    std::array<float, 3> wave{};
  };
  SeparatingAxes axes_of(const Prism& prism) const;

  // How prism and boxes stand to each other, for all children at once.
  struct Separations {
    PerChild<float>
        separation;  // largest distance along an axis, or of a panel its facing away; above 0 they do not meet
    PerChild<float> entry_distance;  // where along the prism the box begins, m
  };
  static void find_separations(const Node& node, const SeparatingAxes& axes, Separations& gaps);

  // A subtree or leaf still to be looked at, and where along the prism it begins.
  struct StackEntry {
    std::int32_t child;
    float entry_distance;
  };
  // All children but one of each level wait at most, and all of the last.
  static constexpr std::size_t kMaxStack = (kMaxChildren - 1) * kMaxLevels + kMaxChildren;
  std::vector<Node> nodes_;       // the first is the root
  std::vector<BvhPanel> panels_;  // in the order of the nodes that hold them
  double slack_ = 0;              // m, of single-precision boxes
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
    // Every child is put on top, and stays there if it meets the prism: no branch that nobody can foresee. To bring the
    // nearest on top costs more than it saves.
    for (int lane = 0; lane < kMaxChildren; ++lane) {
      stack[waiting] = {node.child[lane], gaps.entry_distance[lane]};
      waiting += gaps.separation[lane] <= 0;
    }
  }
}

}  // namespace seaglint

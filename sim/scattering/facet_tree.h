// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Which panels may a beam meet? Embree's tree of boxes over the panels, asked with a prism instead of a ray: nothing is
// missed, however small.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sim/scattering/embree_scene.h"
#include "sim/scattering/panels.h"

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

// A panel as a walk comes upon it: what decides whether a beam meets it, side by side in memory.
struct TreePanel {
  Vec3 normal;                   // unit
  const Vec3* corner = nullptr;  // its outline, counter-clockwise seen against the normal
  std::int32_t facet = -1;       // the one it goes by
  std::uint16_t corners = 0;
  bool open = false;  // either side may be seen

  std::span<const Vec3> outline() const { return {corner, corners}; }
};

// Immutable after construction; any number of threads may ask at once. Facets and panels must outlive it.
class FacetTree {
 public:
  FacetTree(std::span<const Facet> facets, const Panels& panels);

  // Calls visit(panel) for every panel that has a point in the prism and does not face away, and for some whose box
  // only comes near or that lie edge-on, in an order that depends on tree and prism alone. visit returns how far along
  // the prism panels still matter, m; those that begin beyond may be left out.
  template <typename Visit>
  void walk(const Prism& prism, const Visit& visit) const;

 private:
  // Boxes side by side, so that the compiler compares them at once. A child below zero is panel -1 - child.
  template <typename T>
  using OfChildren = std::array<T, kMostChildren>;
  struct alignas(64) Node {
    std::array<OfChildren<float>, 3> centre, half;  // m; half < 0: no box
    // of a panel seen from one side; 0 of all else, which no direction rules out
    std::array<OfChildren<float>, 3> normal;
    OfChildren<std::int32_t> child;
  };
  // A subtree or leaf still to be looked at, and where along the prism it begins.
  struct Waiting {
    std::int32_t child;
    float begin;
  };
  // All children but one of each level wait at most, and all of the last.
  static constexpr std::size_t kMostWaiting = (kMostChildren - 1) * kMostLevels + kMostChildren;
  // Cosine above which a panel faces away for certain, single precision allowed for.
  static constexpr float kFacesAway = 1e-5F;

  std::vector<Node> nodes_;        // the first is the root
  std::vector<TreePanel> panels_;  // in the order of the nodes that hold them
  double slack_ = 0;               // m, of single-precision boxes
};

template <typename Visit>
void FacetTree::walk(const Prism& prism, const Visit& visit) const {
  if (nodes_.empty()) return;
  // |across . centre - middle| <= width + |across| . half, normal . centre + |normal| . half >= offset, and wave .
  // normal of a panel not above zero, for all children at once.
  std::array<std::array<float, 3>, 4> axis, reach;
  std::array<float, 3> wave;
  std::array<float, 2> middle, width;
  for (int i = 0; i < 4; ++i) {
    for (int a = 0; a < 3; ++a) {
      axis[i][a] = static_cast<float>(i < 2 ? prism.across[i][a] : i == 2 ? prism.normal[a] : prism.along[a]);
      reach[i][a] = std::abs(axis[i][a]);
    }
  }
  for (int a = 0; a < 3; ++a) wave[a] = static_cast<float>(prism.wave[a]);
  for (int i = 0; i < 2; ++i) {
    middle[i] = static_cast<float>((prism.lower[i] + prism.upper[i]) / 2);
    width[i] = static_cast<float>((prism.upper[i] - prism.lower[i]) / 2 + slack_);
  }
  const auto offset = static_cast<float>(prism.offset - slack_);
  float far = std::numeric_limits<float>::infinity();
  std::array<Waiting, kMostWaiting> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, -far};
  while (waiting > 0) {
    const Waiting next = stack[--waiting];
    if (next.begin > far) continue;
    if (next.child < 0) {
      far = static_cast<float>(visit(panels_[-1 - next.child]) + slack_);
      continue;
    }
    const Node& node = nodes_[next.child];
    // largest distance between prism and box along an axis, or a panel's facing away; above zero they do not meet
    OfChildren<float> gap;
    OfChildren<float> begin;
    for (int lane = 0; lane < kMostChildren; ++lane) {
      const auto at = [&](int i) {
        return axis[i][0] * node.centre[0][lane] + axis[i][1] * node.centre[1][lane] +
               axis[i][2] * node.centre[2][lane];
      };
      const auto half = [&](int i) {
        return reach[i][0] * node.half[0][lane] + reach[i][1] * node.half[1][lane] + reach[i][2] * node.half[2][lane];
      };
      const float first = std::abs(at(0) - middle[0]) - half(0) - width[0];
      const float second = std::abs(at(1) - middle[1]) - half(1) - width[1];
      const float third = offset - at(2) - half(2);
      const float away =
          wave[0] * node.normal[0][lane] + wave[1] * node.normal[1][lane] + wave[2] * node.normal[2][lane] - kFacesAway;
      const float across = first > second ? first : second, beyond = third > away ? third : away;
      gap[lane] = across > beyond ? across : beyond;
      begin[lane] = at(3) - half(3);
    }
    // Every child is put on top, and stays there if it meets the prism: no branch that nobody can foresee. To bring the
    // nearest on top costs more than it saves.
    for (int lane = 0; lane < kMostChildren; ++lane) {
      stack[waiting] = {node.child[lane], begin[lane]};
      waiting += gap[lane] <= 0;
    }
  }
}

}  // namespace seaglint

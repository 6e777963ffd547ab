// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Wrapper of Embree: the bounding-volume hierarchy that PanelBvh traverses, and ray queries for the first facet hit.
// Ray queries return facet numbers only, since Embree's distances are single precision.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "sim/geometry/surface/facets.h"

namespace seaglint {

struct Ray {
  Vec3 origin;     // m, body frame
  Vec3 direction;  // unit
};

// Rays in single precision, by component, as Embree takes them.
class RayBatch {
 public:
  void clear() {
    for (std::vector<float>& component : component_) component.clear();
  }
  void add(const Vec3& origin, const Vec3& direction) {
    for (int axis = 0; axis < 3; ++axis) {
      component_[axis].push_back(static_cast<float>(origin[axis]));
      component_[axis + 3].push_back(static_cast<float>(direction[axis]));
    }
  }
  std::size_t size() const { return component_[0].size(); }
  // 0, 1, 2: of the origins; 3, 4, 5: of the directions.
  const float* component(int i) const { return component_[i].data(); }

 private:
  std::array<std::vector<float>, 6> component_;
};

inline constexpr int kNoFacet = -1;

struct Box3 {
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 upper = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec3& x) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
};

// Branching factor of the hierarchy.
inline constexpr int kMaxChildren = 8;

// Node of a bounding-volume hierarchy: its children with their boxes, single precision rounded outwards. A child below
// zero is the leaf of input box -1 - child.
struct BvhNode {
  struct Child {
    std::int32_t index = 0;
    std::array<float, 3> lower{}, upper{};  // m
  };
  std::array<Child, kMaxChildren> child;
  int children = 0;
};

// Largest depth of the hierarchy.
inline constexpr int kMaxLevels = 64;

// Bounding-volume hierarchy by Embree's surface-area heuristic, one box per leaf, root first; empty without boxes.
// Equal boxes give equal trees. Throws std::runtime_error when Embree fails.
std::vector<BvhNode> build_bvh(std::span<const Box3> boxes);

// Facets as an Embree scene. Immutable after construction; queries are safe from any number of threads.
class RayScene {
 public:
  // Throws std::invalid_argument with the triangle's number for corners beyond 1e18 m, which Embree would omit, and
  // std::runtime_error with the number of triangles where it can build no tree (memory).
  explicit RayScene(std::span<const Facet> facets);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  // First facet along each ray, or kNoFacet. Rays are traced in packets of 16; neighbouring rays should be coherent.
  void first_hits(const RayBatch& rays, std::span<int> facets) const;
  void first_hits(std::span<const Ray> rays, std::span<int> facets) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seaglint

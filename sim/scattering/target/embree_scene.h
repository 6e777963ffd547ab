// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What Embree builds: trees of boxes, which beams are walked through (PanelBvh), and scenes that answer which facet a
// ray meets first, an independent check of what beams meet. Of a ray only the facet's number is used, since Embree's
// distances are single precision.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "sim/scattering/target/facets.h"

namespace seaglint {

struct Ray {
  Vec3 origin;     // m, body frame
  Vec3 direction;  // unit
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

// Of one node. A walk through a tree of eight to a node passes fewer than one of four; sixteen save no more
// (README.md).
inline constexpr int kMaxChildren = 8;

// A node of a tree of boxes: its children, each with its box as Embree keeps it, in single precision rounded outwards.
// A child below zero is box -1 - child of those given.
struct BvhNode {
  struct Child {
    std::int32_t index = 0;
    std::array<float, 3> lower{}, upper{};  // m
  };
  std::array<Child, kMaxChildren> child;
  int children = 0;
};

// Levels of nodes that build_bvh() never exceeds.
inline constexpr int kMaxLevels = 64;

// Embree's surface-area-heuristic tree over the boxes, one box to a leaf, the root first; the same for the same boxes.
// Empty without boxes.
std::vector<BvhNode> build_bvh(std::span<const Box3> boxes);

// Immutable after construction; any number of threads may trace at once.
class RayScene {
 public:
  explicit RayScene(std::span<const Facet> facets);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  // First facet along each ray, or kNoFacet. Neighbouring rays should be coherent: they are traced in packets of 16.
  void first_hits(std::span<const Ray> rays, std::span<int> facets) const;
  // The same for rays that have nothing in common.
  int first_hit(const Ray& ray) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Which facet does a ray meet first? The one question asked of Embree. Only the facet's number is used: points and
// paths are recomputed in double from its plane, since Embree's distances are single precision.

#include <memory>
#include <span>
#include <vector>

#include "sim/scattering/facets.h"

namespace seaglint {

struct Ray {
  Vec3 origin;     // m, body frame
  Vec3 direction;  // unit
};

inline constexpr int kNoFacet = -1;

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

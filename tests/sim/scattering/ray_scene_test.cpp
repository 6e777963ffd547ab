// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/ray_scene.h"

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <array>
#include <vector>

#include "sim/geometry/generators.h"
#include "sim/scattering/respond.h"

namespace seaglint {
namespace {

TEST(RayScene, LeavesTheCallersFloatingPointModeAsItWas) {
  const Scatterer plate(make_plate(1, 1));
  const std::vector<Ray> rays(20, Ray{Vec3(1, 0.1, 0.2), Vec3(-1, 0, 0)});
  std::vector<int> hits(rays.size(), kNoFacet);
  for (const unsigned flush : {unsigned{_MM_FLUSH_ZERO_OFF}, unsigned{_MM_FLUSH_ZERO_ON}}) {
    const unsigned before = _mm_getcsr();
    _MM_SET_FLUSH_ZERO_MODE(flush);
    const unsigned set = _mm_getcsr();
    plate.rays().first_hits(rays, hits);
    const unsigned after_many = _mm_getcsr();
    const int hit = plate.rays().first_hit(rays.front());
    const unsigned after_one = _mm_getcsr();
    _mm_setcsr(before);
    constexpr unsigned kModes = ~unsigned{_MM_EXCEPT_MASK};  // the exceptions that occurred are no mode
    EXPECT_EQ(after_many & kModes, set & kModes);
    EXPECT_EQ(after_one & kModes, set & kModes);
    EXPECT_NE(hit, kNoFacet);
    for (const int many : hits) EXPECT_EQ(many, hit);
  }
}

}  // namespace
}  // namespace seaglint

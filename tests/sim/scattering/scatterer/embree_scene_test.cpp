// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/embree_scene.h"

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/surface/facets.h"

namespace seaglint {
namespace {

TEST(RayScene, KeepsTheCallersFloatingPointMode) {
  const RayScene plate(make_facets(make_plate(1, 1)));
  const std::vector<Ray> rays(20, Ray{Vec3(1, 0.1, 0.2), Vec3(-1, 0, 0)});
  std::vector<int> hits(rays.size(), kNoFacet);
  for (const unsigned flush : {unsigned{_MM_FLUSH_ZERO_OFF}, unsigned{_MM_FLUSH_ZERO_ON}}) {
    const unsigned before = _mm_getcsr();
    _MM_SET_FLUSH_ZERO_MODE(flush);
    const unsigned set = _mm_getcsr();
    plate.first_hits(rays, hits);
    const unsigned after = _mm_getcsr();
    _mm_setcsr(before);
    constexpr unsigned kModes = ~unsigned{_MM_EXCEPT_MASK};  // the mode without the flags of exceptions that occurred
    EXPECT_EQ(after & kModes, set & kModes);
    for (const int hit : hits) EXPECT_EQ(hit, hits.front());
    EXPECT_NE(hits.front(), kNoFacet);
  }
}

TEST(RayScene, NamesTheTriangleThatEmbreeWouldOmit) {
  std::vector<Facet> facets = make_facets(make_plate(1, 1));
  facets[1].corner[2].x() = 2e18;
  try {
    const RayScene scene(facets);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "Embree takes no triangle 1 of 2: a corner lies beyond 1e18 m");
  }
}

// Every box is a leaf once, and lies in all boxes above it.
TEST(BvhBuild, ContainsEveryBoxOnceWithinItsParents) {
  Random random({29, Stream::kTest, 0});
  for (const int count : {1, 2, 5, 1000}) {
    std::vector<Box3> boxes(count);
    for (Box3& box : boxes) {
      const Vec3 x(random.normal(), random.normal(), random.normal());
      box.add(x);
      // Some without extent, and many identical ones.
      box.add(random.uniform() < 0.5 ? x : Vec3(x + Vec3(random.uniform(), 0, random.uniform())));
      if (random.uniform() < 0.3) box = boxes[0];
    }
    const std::vector<BvhNode> nodes = build_bvh(boxes);
    std::vector<int> visits(count, 0);
    int deepest = 0;
    const auto visit = [&](const auto& self, const BvhNode& node, int level) -> void {
      deepest = std::max(deepest, level);
      for (int i = 0; i < node.children; ++i) {
        const BvhNode::Child& child = node.child[i];
        if (child.index >= 0) {
          for (int k = 0; k < nodes[child.index].children; ++k) {
            for (int a = 0; a < 3; ++a) {
              EXPECT_LE(child.lower[a], nodes[child.index].child[k].lower[a]);
              EXPECT_GE(child.upper[a], nodes[child.index].child[k].upper[a]);
            }
          }
          self(self, nodes[child.index], level + 1);
        } else {
          ++visits[-1 - child.index];
          for (int a = 0; a < 3; ++a) {
            EXPECT_LE(child.lower[a], boxes[-1 - child.index].lower[a]);
            EXPECT_GE(child.upper[a], boxes[-1 - child.index].upper[a]);
          }
        }
      }
    };
    visit(visit, nodes.at(0), 1);
    for (const int times : visits) EXPECT_EQ(times, 1);
    EXPECT_LE(deepest, kMaxLevels);
  }
  EXPECT_TRUE(build_bvh({}).empty());
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Edge illuminations indexed by edge against the lists that they come from.
#include "sim/scattering/tracing/edge_illumination.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sim/core/numbers/random.h"

namespace seaglint {
namespace {

TEST(IlluminationByEdge, ContainsAllOfEachEdgeInTheOrderOfTheirLists) {
  constexpr int kEdges = 50;
  Random random({3, Stream::kTest, 0});
  std::vector<std::vector<EdgeIllumination>> lists(7);
  std::vector<std::vector<double>> expected(kEdges);
  std::size_t count = 0;
  for (auto& list : lists) {
    for (int i = 0; i < 20; ++i) {
      const int edge = 2 * static_cast<int>(0.5 * kEdges * random.uniform());  // every other one has none
      const Vec3 x = Vec3::Zero();
      const EdgeIllumination illumination{
          edge, {static_cast<double>(count++), 0}, {Vec2::Zero(), Vec2::Zero()}, x, x, x, x, x};
      expected[illumination.edge].push_back(illumination.s[0]);
      list.push_back(illumination);
    }
  }
  const IlluminationByEdge illuminations(std::move(lists), kEdges);
  EXPECT_EQ(illuminations.all().size(), count);
  for (int edge = 0; edge < kEdges; ++edge) {
    const auto found_at = [](const EdgeIllumination* illumination) { return illumination->s[0]; };
    EXPECT_TRUE(std::ranges::equal(illuminations.of(edge), expected[edge], {}, found_at)) << edge;
  }
  for (std::size_t n = 0; n <= count; ++n) {
    int edge = 0;
    for (std::size_t before = 0; before < n; ++edge) before += expected[edge].size();
    EXPECT_EQ(illuminations.edge_after(n), edge) << n;
  }
}

TEST(IlluminationByEdge, IsEmptyWithoutIlluminations) {
  const IlluminationByEdge illuminations({}, 3);
  EXPECT_TRUE(illuminations.all().empty());
  EXPECT_TRUE(illuminations.of(2).empty());
  EXPECT_EQ(illuminations.edge_after(0), 0);
}

}  // namespace
}  // namespace seaglint

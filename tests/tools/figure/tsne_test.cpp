// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/tsne.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/random.h"

namespace seaglint {
namespace {

TEST(Tsne, KeepsSeparateClustersApart) {
  FeatureMatrix features{{"a", "b", "c"}, {}};
  Random random({6, Stream::kTest, 0});
  for (int i = 0; i < 80; ++i) {
    for (int k = 0; k < 3; ++k) features.values.push_back(static_cast<float>((i % 2 == 0 ? 0 : 20) + random.normal()));
  }
  const auto points = tsne(features, 15, 300, 1);
  // Every point's nearest neighbour is of its own cluster.
  for (int i = 0; i < 80; ++i) {
    int nearest = -1;
    double best = 1e300;
    for (int j = 0; j < 80; ++j) {
      const double distance = std::hypot(points[i][0] - points[j][0], points[i][1] - points[j][1]);
      if (j != i && distance < best) {
        best = distance;
        nearest = j;
      }
    }
    EXPECT_EQ(nearest % 2, i % 2) << "point " << i;
  }
  EXPECT_EQ(points, tsne(features, 15, 300, 1));
}

TEST(Tsne, AcceptsAnyInput) {
  EXPECT_EQ(tsne(FeatureMatrix{{"a"}, {1, 2, 3}}, 30, 10, 1).size(), 3u);
  for (const auto& point : tsne(FeatureMatrix{{"a"}, std::vector<float>(20, 1.0f)}, 30, 50, 1)) {
    EXPECT_TRUE(std::isfinite(point[0]) && std::isfinite(point[1]));
  }
}

}  // namespace
}  // namespace seaglint

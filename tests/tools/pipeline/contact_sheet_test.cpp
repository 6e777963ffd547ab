// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/contact_sheet.h"

#include <gmock/gmock.h>

#include <array>
#include <set>

namespace seaglint {
namespace {

using Points = std::vector<std::vector<std::size_t>>;

Points points(std::vector<std::size_t> sizes, std::size_t count) { return spread_points(sizes, count); }

// How often each coordinate of an axis is there.
std::vector<int> uses(const Points& all, std::size_t axis, std::size_t size) {
  std::vector<int> count(size, 0);
  for (const auto& point : all) ++count[point[axis]];
  return count;
}

TEST(SpreadPoints, AreAllOfTheGridOnceWhereEnoughAreAskedFor) {
  const Points all = points({3, 2, 1}, 100);
  EXPECT_EQ(all.size(), 6u);
  EXPECT_EQ(std::set(all.begin(), all.end()).size(), 6u);
  EXPECT_EQ(points({1, 1}, 3), (Points{{0, 0}}));
}

TEST(SpreadPoints, HaveEveryCoordinateEquallyOften) {
  const Points some = points({3, 5, 10}, 15);
  EXPECT_THAT(uses(some, 0, 3), testing::Each(5));
  EXPECT_THAT(uses(some, 1, 5), testing::Each(3));
  EXPECT_THAT(uses(some, 2, 10), testing::Each(testing::AllOf(testing::Ge(1), testing::Le(2))));
}

// Of a long axis both ends and the middle, not the first coordinates.
TEST(SpreadPoints, CoverALongAxisWithFew) {
  const Points three = points({1, 101}, 3);
  EXPECT_EQ(three, (Points{{0, 0}, {0, 100}, {0, 50}}));
  EXPECT_EQ(points({1, 101}, 2), (Points{{0, 0}, {0, 100}}));
}

}  // namespace
}  // namespace seaglint

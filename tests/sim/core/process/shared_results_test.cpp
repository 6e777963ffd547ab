// SPDX-License-Identifier: BSD-3-Clause
// Results that several threads need are computed once, and again when they are no longer kept.
#include "sim/core/process/shared_results.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "sim/core/process/parallel.h"

namespace seaglint {
namespace {

TEST(SharedResults, AreComputedOnceByManyThreads) {
  SharedResults<int, int> squares(4);
  std::atomic<int> made = 0;
  parallel_for(400, 4, [&](std::size_t i) {
    const int key = static_cast<int>(i % 4);
    EXPECT_EQ(*squares.get(key,
                           [&] {
                             ++made;
                             return key * key;
                           }),
              key * key);
  });
  EXPECT_EQ(made, 4);
}

TEST(SharedResults, OfTheOldestKeyAreForgottenAndComputedAgain) {
  SharedResults<int, int> kept(2);
  int made = 0;
  const auto make = [&] { return ++made; };
  const auto first = kept.get(1, make);
  kept.get(2, make);
  kept.get(3, make);
  EXPECT_EQ(*kept.get(3, make), 3);
  EXPECT_EQ(*kept.get(2, make), 2);
  EXPECT_EQ(*kept.get(1, make), 4);
  EXPECT_EQ(*first, 1);
}

TEST(SharedResults, ThatFailedAreTriedAgain) {
  SharedResults<int, int> kept(2);
  EXPECT_THROW(kept.get(1, []() -> int { throw std::runtime_error("interrupted"); }), std::runtime_error);
  EXPECT_EQ(*kept.get(1, [] { return 7; }), 7);
}

}  // namespace
}  // namespace seaglint

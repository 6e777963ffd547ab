// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/parallel.h"

#include <gtest/gtest.h>

#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnce) {
  for (const int threads : {1, 2, 3, 16}) {
    for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
      std::vector<std::atomic<int>> visits(count);
      parallel_for(count, threads, [&](std::size_t i) { ++visits[i]; });
      for (const auto& visit : visits) EXPECT_EQ(visit, 1);
    }
  }
}

TEST(ParallelFor, UsesAtMostTheGivenNumberOfThreads) {
  std::mutex mutex;
  std::set<std::thread::id> ids;
  parallel_for(200, 3, [&](std::size_t) {
    const std::scoped_lock lock(mutex);
    ids.insert(std::this_thread::get_id());
  });
  EXPECT_LE(ids.size(), 3u);
}

TEST(ParallelFor, RethrowsTheFailureOfTheLowestIndexForAnyThreadCount) {
  for (int threads = 1; threads <= 8; ++threads) {
    for (int repeat = 0; repeat < 50; ++repeat) {
      try {
        parallel_for(100, threads, [](std::size_t i) {
          // The lowest index fails last.
          if (i == 37) std::this_thread::sleep_for(std::chrono::microseconds(200));
          if (i >= 37) throw std::runtime_error(std::to_string(i));
        });
        FAIL() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "37");
      }
    }
  }
}

TEST(ParallelFor, StopsWhenTheFlagIsSet) {
  for (const int threads : {1, 4}) {
    StopFlag stop{false};
    std::atomic<int> visits{0};
    EXPECT_THROW(parallel_for(
                     1000000, threads,
                     [&](std::size_t) {
                       if (++visits == 10) stop = true;
                     },
                     &stop),
                 Interrupted);
    EXPECT_LT(visits, 1000000);
  }
}

TEST(ParallelFor, MayBeNested) {
  std::vector<std::atomic<int>> visits(100);
  parallel_for(10, 4, [&](std::size_t i) { parallel_for(10, 2, [&](std::size_t j) { ++visits[10 * i + j]; }); });
  for (const auto& visit : visits) EXPECT_EQ(visit, 1);
}

TEST(ThreadCount, IsAtLeastOneAndKeepsARequest) {
  EXPECT_GE(thread_count(0), 1);
  EXPECT_EQ(thread_count(5), 5);
  EXPECT_THROW(thread_count(-1), std::logic_error);
}

}  // namespace
}  // namespace seaglint

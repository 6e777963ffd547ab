// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace seaglint {
namespace {

TEST(ProgressLine, ShowsShareAndTimeLeft) {
  EXPECT_EQ(progress_line("maps", 0, 10, 3), "maps  [....................]   0 %, no estimate yet");
  EXPECT_EQ(progress_line("maps", 1, 4, 10), "maps  [#####...............]  25 %, 30 s left");
  EXPECT_EQ(progress_line("maps", 1, 2, 130), "maps  [##########..........]  50 %, 2 min 10 s left");
  EXPECT_EQ(progress_line("maps", 1, 2, 3700), "maps  [##########..........]  50 %, 1 h 1 min left");
  EXPECT_EQ(progress_line("maps", 999, 1000, 1), "maps  [###################.]  99 %, 1 s left");
  EXPECT_EQ(progress_line("maps", 4, 4, 10), "maps  [####################] 100 %, 0 s left");
  EXPECT_EQ(progress_line("maps", 0, 0, 1), "maps  [####################] 100 %, 0 s left");
}

TEST(Progress, IsSilentWhereThereIsNoTerminal) {
  ::testing::internal::CaptureStderr();
  {
    Progress progress("maps", 2);
    progress.advance();
    std::this_thread::sleep_for(std::chrono::milliseconds(2100));
    progress.advance();
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace seaglint

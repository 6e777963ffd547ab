// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <string>
#include <thread>
#include <vector>

namespace seaglint {
namespace {

TEST(ProgressLine, ContainsFractionAndRemainingTime) {
  EXPECT_EQ(progress_line("maps", 0, 10, 3), "maps  [....................]   0 %, no estimate yet");
  EXPECT_EQ(progress_line("maps", 1, 4, 10), "maps  [#####...............]  25 %, 30 s left");
  EXPECT_EQ(progress_line("maps", 1, 2, 130), "maps  [##########..........]  50 %, 2 min 10 s left");
  EXPECT_EQ(progress_line("maps", 1, 2, 3700), "maps  [##########..........]  50 %, 1 h 1 min left");
  EXPECT_EQ(progress_line("maps", 999, 1000, 1), "maps  [###################.]  99 %, 1 s left");
  EXPECT_EQ(progress_line("maps", 4, 4, 10), "maps  [####################] 100 %, 0 s left");
  EXPECT_EQ(progress_line("maps", 0, 0, 1), "maps  [####################] 100 %, 0 s left");
}

TEST(ProgressLine, ContainsARateForNamedSteps) {
  EXPECT_EQ(progress_line("rcs", 1, 4, 10, "views"), "rcs  [#####...............]  25 %, 30 s left, 0.1 views/s");
  EXPECT_EQ(progress_line("rcs", 0, 4, 10, "views"), "rcs  [....................]   0 %, no estimate yet");
}

TEST(ForecastLine, IsAboutTheWholeOfLongWork) {
  EXPECT_EQ(forecast_line("views", 2, 721, 2, 2), "about 12 min for 721 views on 2 threads");
  EXPECT_EQ(forecast_line("views", 1, 40, 1.1, 1), "about 45 s for 40 views on 1 thread");
  EXPECT_EQ(forecast_line("views", 10, 10000, 9, 8), "about 2.5 h for 10000 views on 8 threads");
  EXPECT_EQ(forecast_line("views", 10, 90, 1, 2), "");
}

// Of 40 steps the first two take a second: 20 s. Said once, to a terminal or not; nothing of short work or near its
// end.
TEST(Progress, ForecastsLongWorkOnceByItsFirstSteps) {
  const auto lines_of = [](std::size_t total, std::size_t first) {
    std::vector<std::string> lines;
    Progress progress("rcs", total, "views");
    progress.announce(first, 2, [&](const std::string& line) { lines.push_back(line); });
    progress.advance();
    std::this_thread::sleep_for(std::chrono::milliseconds(1050));
    for (int n = 0; n < 3; ++n) progress.advance();
    return lines;
  };
  EXPECT_THAT(lines_of(40, 2),
              ::testing::ElementsAre(::testing::MatchesRegex("about [0-9]+ s for 40 views on 2 threads")));
  EXPECT_THAT(lines_of(8, 2), ::testing::IsEmpty());
  EXPECT_THAT(lines_of(40, 5), ::testing::IsEmpty()) << "fewer steps than are made side by side";
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

// The output to a terminal in place of stderr while `work` runs.
template <typename Function>
std::string output_to_terminal(const Function& work) {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  EXPECT_TRUE(terminal >= 0 && ::grantpt(terminal) == 0 && ::unlockpt(terminal) == 0);
  const int inside = ::open(::ptsname(terminal), O_RDWR | O_NOCTTY);
  const int before = ::dup(STDERR_FILENO);
  ::dup2(inside, STDERR_FILENO);
  work();
  ::dup2(before, STDERR_FILENO);
  ::close(before);
  ::close(inside);
  // The kernel passes what is written in pieces; after the last of them reading fails, as the other end is closed.
  std::string output;
  char buffer[4096];
  for (ssize_t count; (count = ::read(terminal, buffer, sizeof buffer)) > 0;)
    output.append(buffer, static_cast<std::size_t>(count));
  ::close(terminal);
  return output;
}

TEST(Progress, DrawsABarOnATerminalAfterTwoSecondsAndErasesIt) {
  const std::string output = output_to_terminal([] {
    Progress progress("maps", 4);
    progress.advance();
    std::this_thread::sleep_for(std::chrono::milliseconds(2100));
    progress.advance();
    progress.advance();  // too soon to be drawn
  });
  EXPECT_THAT(output, ::testing::StartsWith("\rmaps  [##########..........]  50 %, "));
  EXPECT_THAT(output, ::testing::EndsWith(" s left\033[K\r\033[K"));
}

TEST(Progress, IsSilentForShortWork) {
  EXPECT_EQ(output_to_terminal([] {
              Progress progress("maps", 2);
              progress.advance();
              progress.advance();
            }),
            "");
}

}  // namespace
}  // namespace seaglint

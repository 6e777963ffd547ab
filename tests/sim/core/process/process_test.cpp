// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gmock/gmock.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/out_of_memory.h"
#include "sim/core/process/parallel.h"
#include "sim/core/process/printable.h"
#include "sim/core/process/progress.h"
#include "tests/sanitized.h"

namespace seaglint {
namespace {

TEST(AddressSpace, ThatIsMissingIsAnError) {
  EXPECT_NO_THROW(require_address_space(std::size_t{64} << 20, "the work"));
  if (kSanitized) GTEST_SKIP() << "sanitizers map memory of their own";
  rlimit before{};
  ::getrlimit(RLIMIT_AS, &before);
  const rlimit little{std::size_t{1} << 20, before.rlim_max};
  ::setrlimit(RLIMIT_AS, &little);
  std::string message;
  try {
    require_address_space(std::size_t{64} << 20, "the work");
  } catch (const WorkError& error) {
    message = error.what();
  }
  ::setrlimit(RLIMIT_AS, &before);
  EXPECT_THAT(message, testing::StartsWith("out of memory: the work needs 64 MB more"));
}

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

TEST(Printable, KeepsTextOfAnyLanguage) {
  for (const char* text : {"plain, 5 dB", "Größe 2 µm²", "корабль", "軍艦", "🚢", "two\nlines\tand tabs"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatATerminalTakesForACommand) {
  EXPECT_EQ(printable("\x1b]0;title\x07\r\x7f"), "\\x1b]0;title\\x07\\x0d\\x7f");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");  // control sequence introducer of Latin-1
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\xe2\\x80\\xaeb");  // right-to-left override
}

TEST(Printable, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\xff\xfe"
                      "a"),
            "\\xff\\xfea");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");                    // over-long
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond U+10FFFF
  EXPECT_EQ(printable("m\xe2\x82"), "m\\xe2\\x82");                  // cut off
}

TEST(Printable, IsOneLineWhereOneIsWanted) { EXPECT_EQ(on_one_line("a\nb\tc"), "a\\nb\\x09c"); }

std::string encoded(unsigned point) {
  std::string text;
  if (point < 0x80) {
    text += static_cast<char>(point);
  } else {
    const int more = point < 0x800 ? 1 : point < 0x10000 ? 2 : 3;
    constexpr unsigned kLead[] = {0, 0xc0, 0xe0, 0xf0};
    text += static_cast<char>(kLead[more] | (point >> (6 * more)));
    for (int i = more - 1; i >= 0; --i) text += static_cast<char>(0x80 | ((point >> (6 * i)) & 0x3f));
  }
  return text;
}

TEST(Utf8, ContainsEveryCodePointButSurrogates) {
  for (unsigned point = 0; point < 0x110000; ++point) {
    const std::string text = encoded(point);
    const bool surrogate = point >= 0xd800 && point < 0xe000;
    ASSERT_EQ(utf8_prefix(text), surrogate ? 0 : text.size()) << point;
  }
}

TEST(Utf8, EndsAtAnInvalidByte) {
  EXPECT_EQ(utf8_prefix("caf\xe9"), 3u);  // Latin-1
  EXPECT_EQ(utf8_prefix("caf\xc3\xa9"), 5u);
  EXPECT_EQ(utf8_prefix("a\xc3"), 1u);     // cut short
  EXPECT_EQ(utf8_prefix("\x80"), 0u);      // no lead byte
  EXPECT_EQ(utf8_prefix("\xc0\xaf"), 0u);  // overlong encoding
  EXPECT_EQ(utf8_prefix("\xe0\x80\xaf"), 0u);
  EXPECT_EQ(utf8_prefix("\xf4\x90\x80\x80"), 0u);  // beyond the last code point
  EXPECT_EQ(utf8_prefix(""), 0u);
}

TEST(Shown, KeepsPrintableTextInAnyLanguage) {
  EXPECT_EQ(shown("roll [deg]"), "roll [deg]");
  EXPECT_EQ(shown("Neigung \xc2\xb0, \xe6\xb3\xa2 \xf0\x9f\x8c\x8a"),
            "Neigung \xc2\xb0, \xe6\xb3\xa2 \xf0\x9f\x8c\x8a");
  EXPECT_EQ(in_quotes(""), "''");
}

// Escape sequences, C1 controls, marks of the writing direction and bytes that are no UTF-8.
TEST(Shown, HasNoByteThatATerminalObeys) {
  EXPECT_EQ(shown("\x1b[2J\r\n\t\x7f"), "\\x1b[2J\\x0d\\n\\x09\\x7f");
  EXPECT_EQ(shown(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(shown("\xc2\x9b"), "\\xc2\\x9b");
  EXPECT_EQ(shown("\xe2\x80\xae"), "\\xe2\\x80\\xae");
  EXPECT_EQ(shown("\xef\xbb\xbfx"), "\\xef\\xbb\\xbfx");
  EXPECT_EQ(shown("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(shown("caf\xe9"), "caf\\xe9");
  EXPECT_EQ(shown("\xe2\x82"), "\\xe2\\x82");  // cut off
  for (int byte = 0; byte < 256; ++byte)
    for (const char c : shown(std::string(1, static_cast<char>(byte))))
      EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7f) << byte;
}

TEST(Shown, HasAtMost120Characters) {
  EXPECT_EQ(shown(std::string(120, 'x')), std::string(120, 'x'));
  EXPECT_EQ(shown(std::string(5000, 'x')), std::string(120, 'x') + "...");
  std::string degrees, kept;
  for (int n = 0; n < 200; ++n) degrees += "\xc2\xb0";
  for (int n = 0; n < 120; ++n) kept += "\xc2\xb0";
  EXPECT_EQ(shown(degrees), kept + "...");
}

TEST(Escape, CellsOfCsvAreQuotedByRfc4180AndNoFormulas) {
  EXPECT_EQ(csv_cell("deck house 2"), "deck house 2");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(csv_cell("=cmd|calc,\"x"), "\"'=cmd|calc,\"\"x\"");
  for (const char* formula : {"=1", "+1", "-1", "@SUM(A1)"}) EXPECT_EQ(csv_cell(formula)[0], '\'') << formula;
  EXPECT_EQ(csv_cell(" =1"), "' =1");
  EXPECT_EQ(csv_cell(" 1"), "\" 1\"");
  EXPECT_EQ(csv_cell("\t=1\nnext row"), "\\x09=1\\nnext row");
  EXPECT_EQ(csv_cell(""), "");
}

TEST(Escape, MarkdownHasNoStructureOfTheText) {
  EXPECT_EQ(markdown_text("fast-craft_1 (new).glb"), "fast-craft_1 (new).glb");
  EXPECT_EQ(markdown_text("a|b <script> [x](y) `c` &amp;"), "a\\|b \\<script\\> \\[x\\](y) \\`c\\` \\&amp;");
  EXPECT_EQ(markdown_text("a\n# b"), "a\\\\n\\# b");
}

TEST(Escape, InlineCodeOfMarkdownEndsBehindTheText) {
  EXPECT_EQ(markdown_code("quick"), "`quick`");
  EXPECT_EQ(markdown_code("a`b``c"), "``` a`b``c ```");
  EXPECT_EQ(markdown_code("a\nb"), "`a\\nb`");
}

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
  const int inside = ::open(::ptsname(terminal), O_RDWR | O_NOCTTY), before = ::dup(STDERR_FILENO);
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

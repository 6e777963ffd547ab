// SPDX-License-Identifier: BSD-3-Clause
// A process is stopped at a call, another one does the same job meanwhile, and the first goes on: both end, with the
// bytes of one undisturbed process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/faults/injected_fault.h"

namespace seaglint {
namespace {

// Waits for the next change of a child's state; true if it was stopped.
bool waits_stopped(pid_t process, int& status) {
  return ::waitpid(process, &status, WUNTRACED) == process && WIFSTOPPED(status);
}

void expect_same_bytes_of_two(const Job& job, FaultKind kind, std::uint64_t number, JobFolder& folder) {
  const Fault fault{&job, kind, number, kStop};
  folder.undisturbed(job);
  folder.begin(job);
  const MappedCounts counts(folder.beside("counts"));
  const pid_t first = start_words(folder.words(job, counts.launcher(folder, &fault)), folder.beside("first.out"),
                                  folder.beside("first.err"));
  ASSERT_GT(first, 0);
  int status = 0;
  const bool stopped = waits_stopped(first, status);
  EXPECT_TRUE(stopped) << fault.text() << ": not reached";
  const ProgramResult second = run_words(folder.words(job));
  EXPECT_EQ(second.code, 0) << fault.text() << ": the second process: " << second.err;
  EXPECT_THAT(folder.differences(job, true), testing::Each(testing::HasSubstr(".tmp"))) << fault.text();
  if (stopped) {
    ::kill(first, SIGCONT);
    ::waitpid(first, &status, 0);
  }
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0)
      << fault.text() << ": the first process: " << read_file(folder.beside("first.err"));
  EXPECT_EQ(folder.differences(job, true), Words{}) << fault.text();
}

// As many stops of each job as SEAGLINT_STOPS says, at drawn calls that change something.
TEST(Stopped, ProcessesGoOnAfterAnotherHasDoneTheirWork) {
  JobFolder folder;
  const std::uint64_t stops = environment_number("SEAGLINT_STOPS", 1);
  std::uint64_t index = 0;
  for (const Job& job : jobs()) {
    for (std::uint64_t i = 0; i < stops; ++i) {
      Random random({7, Stream::kTest, index++});
      const FaultKind kinds[] = {FaultKind::kOpen, FaultKind::kWrite, FaultKind::kSync, FaultKind::kRename};
      const FaultKind kind = kinds[random.below(4)];
      const std::uint64_t calls = calls_of(job, folder)[static_cast<std::size_t>(kind)];
      expect_same_bytes_of_two(job, kind, 1 + random.below(static_cast<std::uint32_t>(calls)), folder);
    }
  }
}

}  // namespace
}  // namespace seaglint

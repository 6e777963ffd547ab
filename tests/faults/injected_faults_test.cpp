// SPDX-License-Identifier: BSD-3-Clause
// One call of a command fails: the command ends with exit code 1 and one line, or its result is complete; no file of
// other content has a final name, no temporary file is left, and the same command again gives the bytes of an
// undisturbed one. The same after a kill.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>

#include "tests/faults/injected_fault.h"

namespace seaglint {
namespace {

enum Outcome { kHarmless, kResumed, kNotReached, kLost };

// Rows of jobs and kinds with the number of each outcome.
class OutcomeTable {
 public:
  void add(const Fault& fault, Outcome outcome) {
    ++rows_[{fault.job->name, kFaultKinds[static_cast<std::size_t>(fault.kind)]}][outcome];
    ++sums_[outcome];
  }
  std::uint64_t sum(Outcome outcome) const { return sums_[outcome]; }

  std::string text() const {
    std::string text = fmt::format("{:18}{:10}{:>10}{:>10}{:>13}{:>6}\n", "command", "call", "harmless", "resumed",
                                   "not reached", "lost");
    const auto line = [&](const std::string& job, const std::string& kind, const Counts& n) {
      text += fmt::format("{:18}{:10}{:10}{:10}{:13}{:6}\n", job, kind, n[kHarmless], n[kResumed], n[kNotReached],
                          n[kLost]);
    };
    for (const auto& [row, n] : rows_) line(row.first, row.second, n);
    line("all", "", sums_);
    return text;
  }

 private:
  using Counts = std::array<std::uint64_t, 4>;
  std::map<std::pair<std::string, std::string>, Counts> rows_;
  Counts sums_{};
};

// Temporary files are what a kill leaves; a repetition removes them.
Words without_temporaries(Words names) {
  std::erase_if(names, [](const std::string& name) { return name.starts_with("surplus: ") && name.ends_with(".tmp"); });
  return names;
}

// What is wrong after a fault and after the same command again; empty if nothing is. `killed` if the fault ends the
// program.
std::string complaint(JobFolder& folder, const Fault& fault, bool killed, Outcome& outcome) {
  folder.undisturbed(*fault.job);
  folder.begin(*fault.job);
  const MappedCounts counts(folder.beside("counts"));
  const ProgramResult result = run_words(folder.words(*fault.job, counts.launcher(folder, &fault)));
  outcome = kLost;
  std::string what;
  const auto require = [&](bool holds, const std::string& text) {
    if (!holds) what += "\n  " + text;
  };
  const bool was_killed = result.code == 128 + SIGKILL;
  require(result.code == 0 || result.code == 1 || (killed && was_killed), fmt::format("exit code {}", result.code));
  if (result.code != 0 && !was_killed) require(is_one_complaint(result.err), "not one line of complaint");
  Words wrong = folder.differences(*fault.job, result.code == 0);
  if (was_killed) wrong = without_temporaries(wrong);
  require(wrong.empty(), fmt::format("left: {}", fmt::join(wrong, ", ")));
  if (result.code != 0) {
    const ProgramResult again = run_words(folder.words(*fault.job));
    require(again.code == 0, fmt::format("again: exit code {}: {}", again.code, again.err));
    const Words still = folder.differences(*fault.job, true);
    require(still.empty(), fmt::format("again: {}", fmt::join(still, ", ")));
  }
  if (what.empty()) outcome = counts->injected == 0 ? kNotReached : result.code == 0 ? kHarmless : kResumed;
  if (what.empty()) return what;
  return fmt::format("{}, {}\n  {}{}", fault.text(), counts->path.data(), result.err, what);
}

void expect_nothing_lost(std::uint64_t count, bool kills) {
  JobFolder folder;
  OutcomeTable table;
  const std::uint64_t seed = environment_number("SEAGLINT_FAULT_SEED", 1) + (kills ? 1000 : 0);
  for (std::uint64_t i = 0; i < count; ++i) {
    Fault fault = draw_fault(folder, seed, i);
    if (kills) fault.error = kKill;
    Outcome outcome;
    const std::string what = complaint(folder, fault, kills, outcome);
    EXPECT_EQ(what, "") << "draw " << i;
    table.add(fault, outcome);
    if ((i + 1) % 100 == 0 && i + 1 < count) std::cout << table.text() << std::flush;
  }
  std::cout << table.text();
  EXPECT_LE(table.sum(kNotReached), 1 + count / 10) << "the calls of a job are not repeatable";
}

// The name of a new temporary file cannot be looked up: another one is made, and this one removed.
TEST(InjectedFaults, OfTheNamesOfTemporaryFilesLeaveNone) {
  JobFolder folder;
  for (const std::uint64_t number : {1u, 2u, 3u}) {
    const Fault fault{&jobs()[0], FaultKind::kStat, number, EIO, ".tmp"};
    Outcome outcome;
    EXPECT_EQ(complaint(folder, fault, false, outcome), "");
    EXPECT_NE(outcome, kNotReached);
  }
}

// A disk that fails when a file is looked for does not mean that the file is missing, which would let it be replaced.
TEST(InjectedFaults, OfLookingForAUsersCardKeepIt) {
  JobFolder folder;
  const Job& generate = jobs().front();
  folder.undisturbed(generate);
  folder.begin(generate);
  ASSERT_EQ(run_words(folder.words(generate)).code, 0);
  const std::filesystem::path card = folder.path() / "data/README.md", manifest = folder.path() / "data/manifest.json";
  write_file(card, "# Made for the trial in May\n");
  std::uint64_t injected = 0;
  for (std::uint64_t number = 1; injected + 1 == number; ++number) {
    std::filesystem::remove(manifest);
    const MappedCounts counts(folder.beside("counts"));
    const Fault fault{&generate, FaultKind::kStat, number, EIO, "README.md"};
    const ProgramResult result = run_words(folder.words(generate, counts.launcher(folder, &fault)));
    EXPECT_EQ(result.code, counts->injected == 0 ? 0 : 1) << fault.text() << ": " << result.err;
    EXPECT_EQ(read_file(card), "# Made for the trial in May\n") << fault.text();
    injected += counts->injected;
  }
  EXPECT_GE(injected, 1u);
}

// gnuplot checks neither its writes nor whether it could open its data: it has no file in the folder.
TEST(InjectedFaults, DoNotReachGnuplot) {
  JobFolder folder;
  const Job& run = jobs().back();
  folder.undisturbed(run);
  folder.begin(run);
  const MappedCounts counts(folder.beside("counts"));
  const Fault first_write{&run, FaultKind::kWrite, 1, ENOSPC};
  const std::filesystem::path bin = folder.beside("bin");
  std::filesystem::create_directory(bin);
  write_file(bin / "gnuplot", fmt::format("#!/bin/sh\nexec {} /usr/bin/gnuplot \"$@\"\n",
                                          fmt::join(counts.launcher(folder, &first_write), " ")));
  std::filesystem::permissions(bin / "gnuplot", std::filesystem::perms::owner_all);
  const ProgramResult result =
      run_words(folder.words(run, {"/usr/bin/env", "PATH=" + bin.string() + ":/usr/bin:/bin"}));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(folder.differences(run, true), Words{});
  for (const FaultKind kind : {FaultKind::kOpen, FaultKind::kRead, FaultKind::kWrite})
    EXPECT_EQ(counts->calls[static_cast<std::size_t>(kind)].load(), 0u);
}

TEST(InjectedFaults, LoseNothing) { expect_nothing_lost(environment_number("SEAGLINT_FAULTS", 50), false); }

TEST(InjectedFaults, ThatAreKillsLoseNothing) { expect_nothing_lost(environment_number("SEAGLINT_KILLS", 5), true); }

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <iostream>
#include <map>
#include <new>
#include <regex>
#include <string>
#include <vector>

#include "sim/core/numbers/random.h"
#include "tests/faults/fault_counts.h"
#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

// Commands of the program on a tiny scenario, each begun in the same folder with the same files, so that a disturbed
// one can be compared with an undisturbed one byte for byte.

using Bytes = std::map<std::string, std::string>;  // by path below the folder; a folder's name ends in a slash

// A command, repeated by the same words.
struct Job {
  const char* name;
  bool has_data;  // begins with a complete data set in data/
  Words words;    // without the program; "@" stands for the folder
};

const std::vector<Job>& jobs() {
  static const std::vector<Job> all{
      {"generate", false, {"generate", "@/tiny.yaml", "-o", "@/data", "--resume", "--threads", "1"}},
      {"merge", true, {"merge", "@/data"}},
      {"export", true, {"export", "@/data", "-o", "@/npz"}},
      {"export, one file", true, {"export", "@/data", "-o", "@/all.npz"}},
      {"features",
       true,
       {"features", "@/data", "--set", "clutter.scr_db=10", "-o", "@/other", "--resume", "--threads", "1"}},
      {"train", true, {"train", "@/data", "-o", "@/model", "--threads", "1"}},
      {"run", false, {"run", "@/tiny.yaml", "-o", "@/run", "--resume", "--threads", "1"}}};
  return all;
}

// The folder of the jobs, one for each test program.
class JobFolder {
 public:
  JobFolder() {
    begin(jobs().front());
    const ProgramResult generated = run_words(words(jobs().front()));
    EXPECT_EQ(generated.code, 0) << generated.err;
    std::filesystem::copy(path(), with_data_, std::filesystem::copy_options::recursive);
  }

  std::filesystem::path path() const { return folder_.path() / "job"; }
  // A file outside the folder.
  std::filesystem::path beside(const std::string& name) const { return folder_.path() / name; }

  // The files with which a job begins.
  std::filesystem::path start_of(const Job& job) const {
    return job.has_data ? with_data_ : std::filesystem::path(SEAGLINT_SOURCE_DIR "/tests/faults/tiny");
  }

  // Removes all files and copies those with which the job begins.
  void begin(const Job& job) const {
    std::filesystem::remove_all(path());
    std::filesystem::copy(start_of(job), path(), std::filesystem::copy_options::recursive);
  }

  // The words that start the job in the folder, behind those of `launcher`: data sets name their inputs as the scenario
  // does, relative to it or to the working directory.
  Words words(const Job& job, const Words& launcher = {}) const {
    Words all{"/usr/bin/env", "-C", path().string()};
    all.insert(all.end(), launcher.begin(), launcher.end());
    all.push_back(kProgram);
    for (std::string word : job.words) {
      if (word.starts_with('@')) word.replace(0, 1, path().string());
      all.push_back(word);
    }
    return all;
  }

  // What is there now, without the times that a run prints about itself and its count of maps that were kept.
  Bytes bytes() const {
    Bytes found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path())) {
      const std::string name = entry.path().lexically_relative(path());
      if (entry.is_directory()) {
        found[name + "/"];
        continue;
      }
      std::string& content = found[name] = read_file(entry.path());
      static const std::regex of_page("<b>[0-9]+ s</b>|<td>[0-9.]+ s</td>|<td>[0-9]+ / [0-9]+</td>"),
          of_numbers("\"(maps|learning|report|maps_made|maps_kept)\": [-+.e0-9]+");
      if (name == "run/report.html") content = std::regex_replace(content, of_page, "");
      if (name == "run/metrics.json") content = std::regex_replace(content, of_numbers, "");
    }
    return found;
  }

  // The files and folders after the job alone.
  const Bytes& undisturbed(const Job& job) {
    const auto known = undisturbed_.find(job.name);
    if (known != undisturbed_.end()) return known->second;
    begin(job);
    const ProgramResult result = run_words(words(job));
    EXPECT_EQ(result.code, 0) << job.name << ": " << result.err;
    return undisturbed_[job.name] = bytes();
  }

  // Names of what is there and differs from the undisturbed job's. With `all`, also of what is missing; without it,
  // files that are still those of the start count as equal, and the numbers of a run, which are written before the
  // report and again with the report's.
  Words differences(const Job& job, bool all) {
    const Bytes there = bytes();
    const Bytes& right = undisturbed(job);
    Words names;
    for (const auto& [name, content] : there) {
      if (!right.contains(name)) names.push_back("surplus: " + name);
      if (!all && (name == "run/metrics.json" || is_of_start(job, name, content))) continue;
      if (right.contains(name) && right.at(name) != content) names.push_back("other bytes: " + name);
    }
    for (const auto& [name, content] : right)
      if (all && !there.contains(name)) names.push_back("missing: " + name);
    return names;
  }

 private:
  bool is_of_start(const Job& job, const std::string& name, const std::string& content) const {
    const std::filesystem::path file = start_of(job) / name;
    return std::filesystem::is_regular_file(file) && read_file(file) == content;
  }

  TemporaryFolder folder_;
  std::filesystem::path with_data_ = folder_.path() / "with_data";
  std::map<std::string, Bytes> undisturbed_;
};

// The program's complaint: one line at the end, and none but warnings before it.
bool is_one_complaint(const std::string& err) {
  std::istringstream stream(err);
  int complaints = 0;
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("seaglint: ")) return false;
    if (!line.starts_with("seaglint: warning: ")) ++complaints;
  }
  return complaints == 1;
}

// A job in which one call fails, and what is left of it.

struct Fault {
  const Job* job = nullptr;
  FaultKind kind = FaultKind::kOpen;
  std::uint64_t number = 0;  // of the call, from 1
  int error = 0;
  std::string end = {};  // of the paths on which calls are counted

  std::string text() const {
    const char* const name = error == kShort  ? "short"
                             : error == kKill ? "SIGKILL"
                             : error == kStop ? "SIGSTOP"
                                              : ::strerrorname_np(error);
    return fmt::format("{}: {} {} {}: {}", job->name, kFaultKinds[static_cast<std::size_t>(kind)], number, end, name);
  }
};

// The file that the program and the test map.
class MappedCounts {
 public:
  explicit MappedCounts(std::filesystem::path file) : file_(std::move(file)) {
    write_file(file_, std::string(sizeof(FaultCounts), '\0'));
    const int descriptor = ::open(file_.c_str(), O_RDWR | O_CLOEXEC);
    void* const mapped = ::mmap(nullptr, sizeof(FaultCounts), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    ::close(descriptor);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    counts_ = new (mapped) FaultCounts{};
  }
  ~MappedCounts() { ::munmap(counts_, sizeof(FaultCounts)); }
  MappedCounts(const MappedCounts&) = delete;
  MappedCounts& operator=(const MappedCounts&) = delete;

  const FaultCounts& operator*() const { return *counts_; }
  const FaultCounts* operator->() const { return counts_; }

  // The words by which a program runs with the library of faults.
  Words launcher(const JobFolder& folder, const Fault* fault) const {
    Words words{"/usr/bin/env", "LD_PRELOAD=" SEAGLINT_FAULT_SHIM, "SEAGLINT_FAULT_FOLDER=" + folder.path().string(),
                "SEAGLINT_FAULT_COUNTS=" + file_.string()};
    if (fault != nullptr) {
      words.push_back(fmt::format("SEAGLINT_FAULT={}:{}:{}{}{}", kFaultKinds[static_cast<std::size_t>(fault->kind)],
                                  fault->number, fault->error, fault->end.empty() ? "" : ":", fault->end));
    }
    return words;
  }

 private:
  std::filesystem::path file_;
  FaultCounts* counts_ = nullptr;
};

using CallCounts = std::array<std::uint64_t, kFaultKinds.size()>;

// The calls of a job by kind.
const CallCounts& calls_of(const Job& job, JobFolder& folder) {
  static std::map<std::string, CallCounts> known;
  if (known.contains(job.name)) return known[job.name];
  folder.begin(job);
  const MappedCounts counts(folder.beside("counts"));
  const ProgramResult result = run_words(folder.words(job, counts.launcher(folder, nullptr)));
  EXPECT_EQ(result.code, 0) << job.name << ": " << result.err;
  EXPECT_EQ(folder.differences(job, true), Words{}) << job.name << ": counting changes the result";
  CallCounts& calls = known[job.name];
  std::copy(counts->calls.begin(), counts->calls.end(), calls.begin());
  return calls;
}

// What a call of a kind may fail with.
const std::vector<int>& errors_of(FaultKind kind) {
  static const std::map<FaultKind, std::vector<int>> errors{{FaultKind::kOpen, {EIO, ENOSPC, EDQUOT, EINTR, EMFILE}},
                                                            {FaultKind::kRead, {EIO, EINTR, kShort}},
                                                            {FaultKind::kWrite, {EIO, ENOSPC, EDQUOT, EINTR, kShort}},
                                                            {FaultKind::kSync, {EIO, ENOSPC, EDQUOT, EINTR}},
                                                            {FaultKind::kRename, {EIO, ENOSPC, EDQUOT}},
                                                            {FaultKind::kClose, {EIO, ENOSPC, EDQUOT, EINTR}},
                                                            {FaultKind::kTruncate, {EIO, ENOSPC, EINTR}},
                                                            {FaultKind::kUnlink, {EIO}},
                                                            {FaultKind::kMkdir, {EIO, ENOSPC, EDQUOT}},
                                                            {FaultKind::kStat, {EIO}},
                                                            {FaultKind::kList, {EIO}}};
  return errors.at(kind);
}

// Draw number `index`: a job, a kind that it calls, one of these calls. A run takes as long as five other jobs, and is
// one in ten.
Fault draw_fault(JobFolder& folder, std::uint64_t seed, std::uint64_t index) {
  Random random({seed, Stream::kTest, index});
  Fault fault;
  fault.job = &(index % 10 == 9 ? jobs().back() : jobs()[index % (jobs().size() - 1)]);
  const CallCounts& calls = calls_of(*fault.job, folder);
  std::vector<FaultKind> kinds;
  for (std::size_t kind = 0; kind < calls.size(); ++kind)
    if (calls[kind] > 0) kinds.push_back(static_cast<FaultKind>(kind));
  const auto below = [&](std::uint64_t count) { return random.below(static_cast<std::uint32_t>(count)); };
  fault.kind = kinds[below(kinds.size())];
  fault.number = 1 + below(calls[static_cast<std::size_t>(fault.kind)]);
  const std::vector<int>& errors = errors_of(fault.kind);
  fault.error = errors[below(errors.size())];
  return fault;
}

// A number of the environment, as tools/faults sets it.
std::uint64_t environment_number(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

// One call of a command fails: the command ends with exit code 1 and one line, or its result is complete; no file of
// other content has a final name, no temporary file is left, and the same command again gives the bytes of an
// undisturbed one. The same after a kill.

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

// A process is stopped at a call, another one does the same job meanwhile, and the first goes on: both end, with the
// bytes of one undisturbed process.

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

// The commands where something that most systems have is missing or different: the same bytes, or one line and nothing
// left.

JobFolder& folder() {
  static JobFolder made;
  return made;
}

void expect_same_bytes(const Job& job, const Words& launcher) {
  folder().undisturbed(job);
  folder().begin(job);
  const ProgramResult result = run_words(folder().words(job, launcher));
  EXPECT_EQ(result.code, 0) << job.name << ": " << result.err;
  EXPECT_EQ(folder().differences(job, true), Words{}) << job.name;
}

bool has_locale(const std::string& name) {
  const ProgramResult all = run_words({"/usr/bin/locale", "-a"});
  return all.out.find(name) != std::string::npos;
}

// Neither a home nor a folder for temporary files, no time zone and no language.
TEST(Surroundings, WithoutAnEnvironmentGiveTheSameBytes) {
  for (const Job& job : jobs()) expect_same_bytes(job, {"/usr/bin/env", "-i", "PATH=/usr/bin:/bin"});
}

// Folders that do not exist, and decimal commas; where the system has no such language, one that it does not know.
TEST(Surroundings, OfMissingFoldersAndAnotherLanguageGiveTheSameBytes) {
  const std::string language = has_locale("de_DE.utf8") ? "LC_ALL=de_DE.utf8" : "LC_ALL=de_DE";
  for (const Job& job : jobs())
    expect_same_bytes(job, {"/usr/bin/env", "HOME=/nonexistent", "TMPDIR=/nonexistent", language});
}

TEST(Surroundings, OfAContainerGiveTheSameBytes) {
  const Words container{"/usr/bin/unshare", "--pid", "--mount-proc", "--fork"};
  if (run_words(with(container, {"/bin/true"})).code != 0) GTEST_SKIP() << "no process namespaces (needs root)";
  for (const Job& job : {jobs()[0], jobs()[4]}) expect_same_bytes(job, container);
}

// The job's folder on a disk of its own; only root is allowed to mount one.
class SmallDisk : public testing::Test {
 protected:
  // False, and the test is skipped, without the permission.
  bool mount(const Job& job, const std::string& size) {
    folder().undisturbed(job);
    std::filesystem::remove_all(folder().path());
    std::filesystem::create_directory(folder().path());
    if (::mount("tmpfs", folder().path().c_str(), "tmpfs", 0, ("size=" + size).c_str()) != 0) return false;
    for (const auto& entry : std::filesystem::directory_iterator(folder().start_of(job)))
      std::filesystem::copy(entry.path(), folder().path() / entry.path().filename(),
                            std::filesystem::copy_options::recursive);
    return true;
  }

  void remount(const std::string& size, unsigned long flags) {
    EXPECT_EQ(::mount("tmpfs", folder().path().c_str(), "tmpfs", MS_REMOUNT | flags, ("size=" + size).c_str()), 0);
  }

  void TearDown() override { ::umount(folder().path().c_str()); }

  // Sizes in kB between that of the files with which the job begins and that with its results.
  std::vector<std::uintmax_t> sizes(const Job& job, int count) {
    const auto kilobytes = [](const std::filesystem::path& path) {
      std::uintmax_t sum = 0;
      for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
        sum += entry.is_regular_file() ? (entry.file_size() + 4095) / 4096 * 4 : 4;
      return sum;
    };
    folder().undisturbed(job);
    folder().begin(job);
    EXPECT_EQ(run_words(folder().words(job)).code, 0);
    const std::uintmax_t least = kilobytes(folder().start_of(job)) + 4, most = kilobytes(folder().path());
    std::vector<std::uintmax_t> found;
    for (int i = 0; i < count; ++i)
      found.push_back(least + (most - least) * static_cast<unsigned>(i) / static_cast<unsigned>(count));
    return found;
  }

  void expect_refused(const Job& job) {
    const ProgramResult result = run_words(folder().words(job));
    EXPECT_EQ(result.code, 1) << job.name << ": " << result.err;
    EXPECT_TRUE(is_one_complaint(result.err)) << job.name << ": " << result.err;
    EXPECT_EQ(folder().differences(job, false), Words{}) << job.name;
  }
};

TEST_F(SmallDisk, ThatIsFullEndsEveryCommandWithOneLineAndAgainGivesTheSameBytes) {
  for (const Job& job : jobs()) {
    const bool is_slow = &job == &jobs().back();
    for (const std::uintmax_t size : sizes(job, is_slow ? 1 : 2)) {
      if (!mount(job, std::to_string(size) + "k")) GTEST_SKIP() << "cannot mount a small disk (needs root)";
      expect_refused(job);
      remount("64m", 0);
      const ProgramResult again = run_words(folder().words(job));
      EXPECT_EQ(again.code, 0) << job.name << ": " << again.err;
      EXPECT_EQ(folder().differences(job, true), Words{}) << job.name << ", " << size << " kB";
      ::umount(folder().path().c_str());
    }
  }
}

TEST_F(SmallDisk, ThatIsReadOnlyEndsEveryCommandWithOneLine) {
  for (const Job& job : jobs()) {
    if (!mount(job, "64m")) GTEST_SKIP() << "cannot mount a small disk (needs root)";
    remount("64m", MS_RDONLY);
    expect_refused(job);
    ::umount(folder().path().c_str());
  }
}

}  // namespace
}  // namespace seaglint

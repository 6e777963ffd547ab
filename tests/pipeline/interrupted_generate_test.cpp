// SPDX-License-Identifier: BSD-3-Clause
// Data sets that are made under difficulties: killed at any moment, by many processes at once, on a disk that is full.
// What was finished stays, what ends is the same bytes as without the difficulty.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include <chrono>
#include <functional>
#include <map>
#include <thread>

#include "sim/core/numbers/random.h"
#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

using Seconds = std::chrono::duration<double>;
using Words = std::vector<std::string>;

// 10 shards of 2 maps.
Words generate(const fs::path& directory, const Words& more) {
  Words words{kProgram,          "generate", "scenarios/points.yaml",    "-o",
              directory,         "--set",    "dataset.maps_per_shard=2", "--set",
              "radar.pulses=64", "--set",    "dataset.maps_per_case=5"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::map<std::string, std::string> bytes_of(const fs::path& directory) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : fs::directory_iterator(directory)) bytes[entry.path().filename()] = read_file(entry.path());
  return bytes;
}

struct Undisturbed {
  std::map<std::string, std::string> bytes;
  Seconds time{0};
};

// The data set made by one thread in one run.
const Undisturbed& undisturbed() {
  static const Undisturbed result = [] {
    const TemporaryFolder folder;
    const auto begin = std::chrono::steady_clock::now();
    const ProgramResult made = run_words(generate(folder.path() / "data", {"--threads", "1"}));
    const Seconds time = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(made.code, 0) << made.err;
    return Undisturbed{bytes_of(folder.path() / "data"), time};
  }();
  return result;
}

// Names of the files that are not as in the undisturbed data set.
Words differences(const fs::path& directory) {
  Words names;
  const auto bytes = bytes_of(directory);
  for (const auto& [name, content] : bytes) {
    if (!undisturbed().bytes.contains(name) || undisturbed().bytes.at(name) != content) names.push_back(name);
  }
  for (const auto& [name, content] : undisturbed().bytes) {
    if (!bytes.contains(name)) names.push_back(name);
  }
  return names;
}

// The finished shards of a directory and which file each is: made again it would be another one.
using Finished = std::map<std::string, std::pair<ino_t, std::int64_t>>;
Finished finished_shards(const fs::path& directory) {
  Finished shards;
  std::error_code absent;
  for (fs::directory_iterator it(directory, absent), end; !absent && it != end; it.increment(absent)) {
    struct stat status {};
    if (it->path().extension() != ".h5" || ::stat(it->path().c_str(), &status) != 0) continue;
    shards[it->path().filename()] = {status.st_ino, status.st_mtim.tv_sec * 1000000000LL + status.st_mtim.tv_nsec};
  }
  return shards;
}

void expect_kept(const Finished& before, const Finished& after) {
  for (const auto& [name, file] : before) {
    ASSERT_TRUE(after.contains(name)) << name << " was lost";
    EXPECT_EQ(after.at(name), file) << name << " was generated again";
  }
}

// Starts the program and kills it a time after `begun` first holds, at once if not. True when it was still running
// then.
bool run_and_kill(Words words, Seconds after, const std::function<bool()>& begun) {
  const pid_t process = start_words(std::move(words), "/dev/null", "/dev/null");
  if (process < 0) return false;
  siginfo_t ended{};
  while (!begun()) {
    if (::waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
        ended.si_pid == process)
      break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::this_thread::sleep_for(after);
  ::kill(process, SIGKILL);
  int status = 0;
  ::waitpid(process, &status, 0);
  if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGKILL;
  EXPECT_EQ(WEXITSTATUS(status), 0);
  return false;
}

TEST(InterruptedGenerate, LosesNoFinishedShardInTwentyKills) {
  constexpr int kKills = 20;
  int kills = 0, runs = 0;
  std::size_t kept = 0, killed_between_shards = 0;
  while (kills < kKills) {
    const TemporaryFolder folder;
    const fs::path data = folder.path() / "data";
    for (bool killed = true; killed && kills < kKills; ++runs) {
      ASSERT_LT(runs, 10 * kKills) << "the program ends before it can be killed";
      Random random({3, Stream::kTest, static_cast<std::uint64_t>(runs)});
      const Finished before = finished_shards(data);
      // At any moment, or soon after a shard: on a busy machine the program's start takes longer than all its work.
      const bool at_any = runs % 4 < 2;
      const Seconds after = undisturbed().time * random.uniform() * (at_any ? 1 : 0.1);
      killed = run_and_kill(generate(data, {"--resume", "--threads", runs % 2 == 0 ? "1" : "2"}), after,
                            [&] { return at_any || finished_shards(data).size() > before.size(); });
      const Finished left = finished_shards(data);
      expect_kept(before, left);
      kept += before.size();
      if (killed) ++kills;
      if (killed && !left.empty() && left.size() < 10) ++killed_between_shards;
    }
    const Finished before = finished_shards(data);
    const ProgramResult last = run_words(generate(data, {"--resume"}));
    ASSERT_EQ(last.code, 0) << last.err;
    EXPECT_THAT(last.out, HasSubstr(std::to_string(2 * before.size()) + " kept"));
    expect_kept(before, finished_shards(data));
    EXPECT_THAT(differences(data), IsEmpty());
  }
  EXPECT_GT(kept, 0u);
  EXPECT_GT(killed_between_shards, 0u) << "no kill left a data set in part";
}

// They race for the directory, scenario.yaml, the manifest and the data card.
TEST(InterruptedGenerate, GivesTheSameBytesInSevenPartsAtTheSameTime) {
  const TemporaryFolder folder;
  const fs::path data = folder.path() / "data";
  std::vector<ProgramResult> results(7);
  {
    std::vector<std::jthread> parts;
    for (int i = 6; i >= 0; --i) {
      parts.emplace_back([&, i] {
        results[static_cast<std::size_t>(i)] = run_words(
            generate(data, {"--part", std::to_string(i + 1) + "/7", "--resume", "--threads", i % 2 == 0 ? "1" : "2"}));
      });
    }
  }
  for (const ProgramResult& result : results) EXPECT_EQ(result.code, 0) << result.err;
  // The last two may each have seen the other's shards or not; one more look settles it.
  ASSERT_EQ(run_words(generate(data, {"--resume"})).code, 0);
  EXPECT_THAT(differences(data), IsEmpty());
}

// The first to end clears up while the other still writes.
TEST(InterruptedGenerate, GivesTheSameBytesWhenTwoProcessesMakeAllOfIt) {
  for (int round = 0; round < 4; ++round) {
    const TemporaryFolder folder;
    const fs::path data = folder.path() / "data";
    std::vector<ProgramResult> results(2);
    {
      std::vector<std::jthread> processes;
      for (ProgramResult& result : results) {
        processes.emplace_back([&] { result = run_words(generate(data, {"--resume", "--threads", "1"})); });
        std::this_thread::sleep_for(undisturbed().time / 10);
      }
    }
    for (const ProgramResult& result : results) EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(differences(data), IsEmpty());
  }
}

void expect_one_line(const ProgramResult& result, const std::string& message) {
  EXPECT_EQ(result.code, 1) << result.err;
  EXPECT_THAT(result.err, HasSubstr(message));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST(InterruptedGenerate, SaysThatAFileMayNotGrowAndResumes) {
  const TemporaryFolder folder;
  const fs::path data = folder.path() / "data";
  // 50 KiB hold scenario.yaml, no shard; without the signal a write beyond it fails.
  Words words{"/bin/bash", "-c", "trap '' XFSZ; ulimit -f 50; exec \"$@\"", "limited"};
  const Words command = generate(data, {"--resume"});
  words.insert(words.end(), command.begin(), command.end());
  const ProgramResult limited = run_words(words);
  expect_one_line(limited, ": File too large");
  EXPECT_THAT(limited.err, HasSubstr((data / "shard_0000").string()));
  for (const auto& entry : fs::directory_iterator(data)) EXPECT_EQ(entry.path().filename(), "scenario.yaml");
  ASSERT_EQ(run_words(command).code, 0);
  EXPECT_THAT(differences(data), IsEmpty());
}

// A disk of its own, in memory; only root may mount one.
class DiskErrors : public testing::Test {
 protected:
  void SetUp() override {
    if (::mount("tmpfs", folder_.path().c_str(), "tmpfs", 0, "size=1m") != 0)
      GTEST_SKIP() << "cannot mount a small disk: " << std::strerror(errno) << " (needs root)";
  }
  void TearDown() override { ::umount(folder_.path().c_str()); }

  TemporaryFolder folder_;
  fs::path data_ = folder_.path() / "data";
};

TEST_F(DiskErrors, ThatIsFullEndsWithAMessageAndADataSetThatResumes) {
  const ProgramResult full = run_words(generate(data_, {"--resume"}));
  expect_one_line(full, ": No space left on device");
  const Finished before = finished_shards(data_);
  EXPECT_GT(before.size(), 0u);
  for (const auto& entry : fs::directory_iterator(data_)) EXPECT_NE(entry.path().extension(), ".tmp");
  ASSERT_EQ(::mount("tmpfs", folder_.path().c_str(), "tmpfs", MS_REMOUNT, "size=16m"), 0);
  const ProgramResult resumed = run_words(generate(data_, {"--resume"}));
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  expect_kept(before, finished_shards(data_));
  EXPECT_THAT(differences(data_), IsEmpty());
}

TEST_F(DiskErrors, ThatBecameReadOnlyEndsWithAMessage) {
  fs::create_directories(data_);
  ASSERT_EQ(::mount("tmpfs", folder_.path().c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, "size=16m"), 0);
  expect_one_line(run_words(generate(data_, {"--resume"})),
                  data_.string() + ": the directory is not writable: Read-only");
  ASSERT_EQ(::mount("tmpfs", folder_.path().c_str(), "tmpfs", MS_REMOUNT, "size=16m"), 0);
  ASSERT_EQ(run_words(generate(data_, {"--resume"})).code, 0);
  EXPECT_THAT(differences(data_), IsEmpty());
}

}  // namespace
}  // namespace seaglint

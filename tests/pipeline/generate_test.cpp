// SPDX-License-Identifier: BSD-3-Clause
// Data sets made by the real program: the same bytes whatever the threads, the parts, the kills.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <map>
#include <thread>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

using Bytes = std::map<std::string, std::string>;  // by file name

Bytes bytes_of(const fs::path& directory) {
  Bytes bytes;
  for (const auto& entry : fs::directory_iterator(directory)) bytes[entry.path().filename()] = read_file(entry.path());
  return bytes;
}

// Names of the files that differ or are missing on one side.
std::vector<std::string> differences(const Bytes& a, const Bytes& b) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : a) {
    if (!b.contains(name) || b.at(name) != bytes) names.push_back(name);
  }
  for (const auto& [name, bytes] : b) {
    if (!a.contains(name)) names.push_back(name);
  }
  return names;
}

std::vector<std::string> generate(const fs::path& directory, std::vector<std::string> more) {
  std::vector<std::string> arguments{"generate", "scenarios/points.yaml",   "-o", directory,
                                     "--set",    "dataset.maps_per_shard=5"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// The same small data set, made once without anything happening.
const Bytes& undisturbed() {
  static const Bytes bytes = [] {
    const TemporaryFolder folder;
    const ProgramResult result = run_program(generate(folder.path() / "data", {"--threads", "1"}));
    EXPECT_EQ(result.code, 0) << result.err;
    return bytes_of(folder.path() / "data");
  }();
  return bytes;
}

std::size_t shards_in(const fs::path& directory) {
  std::error_code error;
  std::size_t count = 0;
  for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error)) {
    count += it->path().extension() == ".h5" ? 1 : 0;
  }
  return count;
}

// Starts the program and sends a signal once `shards` shards are there; returns what ended it.
int run_and_signal(const std::vector<std::string>& arguments, const fs::path& directory, std::size_t shards,
                   int signal) {
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), kProgram);
  const pid_t process = start_words(std::move(words), "/dev/null", directory.string() + ".err");
  if (process < 0) return -1;
  int status = 0;
  while (::waitpid(process, &status, WNOHANG) == 0) {
    if (shards_in(directory) >= shards) {
      ::kill(process, signal);
      ::waitpid(process, &status, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST(Generate, GivesTheSameBytesForAnyNumberOfThreads) {
  for (const char* threads : {"2", "5"}) {
    const TemporaryFolder folder;
    const ProgramResult result = run_program(generate(folder.path() / "data", {"--threads", threads}));
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(differences(bytes_of(folder.path() / "data"), undisturbed()), testing::IsEmpty());
  }
}

TEST(Generate, GivesTheSameBytesInPartsInAnyOrder) {
  const TemporaryFolder folder;
  for (const char* part : {"3/3", "1/3", "2/3"}) {
    EXPECT_FALSE(fs::exists(folder.path() / "data" / "manifest.json"));
    const ProgramResult result = run_program(generate(folder.path() / "data", {"--part", part, "--resume"}));
    ASSERT_EQ(result.code, 0) << result.err;
  }
  EXPECT_THAT(differences(bytes_of(folder.path() / "data"), undisturbed()), testing::IsEmpty());
}

TEST(Generate, GivesTheSameBytesAfterKillsAndResumes) {
  const TemporaryFolder folder;
  const fs::path data = folder.path() / "data";
  int killed = 0;
  for (const std::size_t shards : {1u, 3u, 6u}) {
    killed +=
        run_and_signal(generate(data, {"--resume", "--threads", "2"}), data, shards, SIGKILL) == 128 + SIGKILL ? 1 : 0;
    EXPECT_FALSE(fs::exists(data / "manifest.json") && shards_in(data) < 8);
  }
  EXPECT_GE(killed, 1) << "no run lived long enough to be killed";
  const ProgramResult result = run_program(generate(data, {"--resume"}));
  ASSERT_EQ(result.code, 0) << result.err;
  // A kill may leave the temporary file of a shard; the next run replaces it.
  EXPECT_THAT(differences(bytes_of(data), undisturbed()), testing::IsEmpty());
}

TEST(Generate, MakesADamagedShardAgain) {
  const TemporaryFolder folder;
  const fs::path data = folder.path() / "data";
  ASSERT_EQ(run_program(generate(data, {})).code, 0);
  fs::resize_file(data / "shard_00002.h5", fs::file_size(data / "shard_00002.h5") / 2);
  const ProgramResult result = run_program(generate(data, {"--resume"}));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("5 maps made"));
  EXPECT_THAT(differences(bytes_of(data), undisturbed()), testing::IsEmpty());
}

TEST(Generate, StopsCleanlyAtControlCAndSaysHowToGoOn) {
  const TemporaryFolder folder;
  const fs::path data = folder.path() / "data";
  const auto arguments = generate(data, {"--threads", "1", "--set", "dataset.maps_per_case=100"});
  EXPECT_EQ(run_and_signal(arguments, data, 2, SIGINT), 1);
  EXPECT_THAT(read_file(data.string() + ".err"), HasSubstr("--resume"));
  for (const auto& [name, bytes] : bytes_of(data)) EXPECT_FALSE(name.ends_with(".tmp")) << name;
  EXPECT_FALSE(fs::exists(data / "manifest.json"));
}

TEST(Generate, RefusesADirectoryThatIsNotEmpty) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(generate(folder.path() / "data", {})).code, 0);
  const ProgramResult again = run_program(generate(folder.path() / "data", {}));
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("not empty"));
  const ProgramResult other = run_program(generate(folder.path() / "data", {"--resume", "--set", "seed=43"}));
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("another scenario"));
}

TEST(Generate, RefusesWhatCannotBe) {
  const TemporaryFolder folder;
  for (const char* part : {"0/3", "4/3", "1", "a/b", "1/", "-1/2", "1/2/3"}) {
    const ProgramResult result = run_program(generate(folder.path() / "data", {"--part", part}));
    EXPECT_EQ(result.code, 2) << part;
    EXPECT_THAT(result.err, HasSubstr("--part")) << part;
  }
  EXPECT_FALSE(fs::exists(folder.path() / "data"));
  const ProgramResult file = run_program(generate("/dev/null/data", {}));
  EXPECT_EQ(file.code, 1) << file.err;
}

TEST(Generate, GivesTheSameBytesOfRealTargetsForOneAndTwoThreads) {
  Bytes first;
  for (const char* threads : {"1", "2"}) {
    const TemporaryFolder folder;
    const ProgramResult result =
        run_program({"generate", "scenarios/quick.yaml", "-o", folder.path() / "data", "--threads", threads, "--set",
                     "view.azimuth_deg=50", "--set", "sea.significant_wave_height_m=1", "--set",
                     "dataset.maps_per_case=2", "--set", "dataset.realisations_per_case=1"});
    ASSERT_EQ(result.code, 0) << result.err;
    if (first.empty()) {
      first = bytes_of(folder.path() / "data");
    } else {
      EXPECT_THAT(differences(bytes_of(folder.path() / "data"), first), testing::IsEmpty());
    }
  }
}

}  // namespace
}  // namespace seaglint

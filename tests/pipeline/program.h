// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Runs the program as a user does.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "sim/core/process/file.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {

struct ProgramResult {
  int code = -1;  // exit code; 128 + n when signal n ended it
  std::string out, err;
};

inline constexpr const char* kProgram = SEAGLINT_BINARY_DIR "/seaglint";

inline constexpr const char* kPython = "/usr/bin/python3";  // Debian's packages are for Debian's Python

// Starts any program, words[0], with the project's root as working directory; both output files are overwritten.
inline pid_t start_words(std::vector<std::string> words, const std::string& out, const std::string& err) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, SEAGLINT_SOURCE_DIR);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
  // A shell starts what runs in the background with Ctrl-C ignored, which a new process inherits.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t defaults;
  sigemptyset(&defaults);
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM}) sigaddset(&defaults, signal);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t process = 0;
  const int error = posix_spawn(&process, argv[0], &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error == 0) return process;
  ADD_FAILURE() << words.front() << ": " << std::strerror(error);
  return -1;
}

// The same, and waits for its end.
inline ProgramResult run_words(std::vector<std::string> words) {
  const TemporaryFolder folder;
  const std::string out = folder.path() / "out", err = folder.path() / "err";
  const pid_t process = start_words(std::move(words), out, err);
  ProgramResult result;
  if (process < 0) return result;
  int status = 0;
  ::waitpid(process, &status, 0);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = read_file(out);
  result.err = read_file(err);
  return result;
}

inline const std::string kPoints = "scenarios/points.yaml";

using Words = std::vector<std::string>;

inline Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// The same with `--set` before each of the settings.
inline Words with_settings(Words words, const Words& settings) {
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  return words;
}
// `seaglint arguments... more...`
inline ProgramResult run_program(const Words& arguments, const Words& more = {}) {
  return run_words(with(with({kProgram}, arguments), more));
}

// A run that must have ended with exit code 0.
inline ProgramResult completed(ProgramResult result) {
  EXPECT_EQ(result.code, 0) << result.err << result.out;
  return result;
}

inline ProgramResult completed(const Words& arguments, const Words& more = {}) {
  SCOPED_TRACE(testing::PrintToString(arguments));
  return completed(run_program(arguments, more));
}

// Lines of the error output that are complaints: neither warnings nor what the program says about its input.
inline int complaints_in(const std::string& err) {
  std::istringstream lines(err);
  int count = 0;
  for (std::string line; std::getline(lines, line);)
    count += line.starts_with("seaglint: ") && !line.starts_with("seaglint: warning: ");
  return count;
}

// Exit code 2, and one complaint of one line, which contains `sentence`.
inline void expect_refused(const ProgramResult& result, const std::string& sentence) {
  EXPECT_EQ(result.code, 2) << result.out;
  EXPECT_HAS(result.err, sentence);
  EXPECT_EQ(complaints_in(result.err), 1) << result.err;
}

inline void expect_refused(const Words& arguments, const std::string& sentence) {
  SCOPED_TRACE(testing::PrintToString(arguments));
  expect_refused(run_program(arguments), sentence);
}

// Contents of the files of a folder, by name.
inline std::map<std::string, std::string> bytes_of(const std::filesystem::path& directory) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    bytes[entry.path().filename()] = read_file(entry.path());
  return bytes;
}

// Names of the files that differ or are missing on one side.
inline Words differences(const std::map<std::string, std::string>& a, const std::map<std::string, std::string>& b) {
  Words names;
  for (const auto& [name, bytes] : a)
    if (!b.contains(name) || b.at(name) != bytes) names.push_back(name);
  for (const auto& [name, bytes] : b)
    if (!a.contains(name)) names.push_back(name);
  return names;
}

// Names of what is in a folder.
inline Words names_in(const std::filesystem::path& directory) {
  Words names;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) names.push_back(entry.path().filename());
  return names;
}

// A folder that all tests of a suite share.
class SharedFolder : public testing::Test {
 protected:
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string path(const std::string& name) {
    if (!folder_) folder_ = std::make_unique<TemporaryFolder>();
    return folder_->path() / name;
  }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
};
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Runs the program as a user does.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/process/file.h"
#include "tests/temporary_folder.h"

namespace seaglint {

struct ProgramResult {
  int code = -1;  // exit code; 128 + n when signal n ended it
  std::string out;
  std::string err;
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
  const std::string out = folder.path() / "out";
  const std::string err = folder.path() / "err";
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

// `seaglint arguments...`
inline ProgramResult run_program(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{kProgram};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_words(std::move(words));
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Errors: wrong input, failed work, interruption; and the check for programmer errors.

#include <stdexcept>
#include <string>
#include <vector>

namespace seaglint {

// Wrong user input; exit code 2. The message names file:line:col, key path, value and bound where they exist.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Several mistakes in one input, reported together. what(): all messages, each on a line of its own.
class SeveralInputErrors : public InputError {
 public:
  explicit SeveralInputErrors(std::vector<std::string> messages);  // at least one
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

// The messages of an error: those of SeveralInputErrors, else the one that it is.
std::vector<std::string> messages_of(const InputError& error);

// Throws an InputError with these messages, with SeveralInputErrors for more than one; at least one.
[[noreturn]] void throw_input_errors(std::vector<std::string> messages);

// The work failed on valid input (disk full, no permission); exit code 1.
class WorkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Interrupted by Ctrl-C; exit code 1, no partial files.
class Interrupted : public WorkError {
 public:
  Interrupted() : WorkError("interrupted") {}
};

[[noreturn]] void fail_check(const char* condition, const char* file, int line, const std::string& detail);

}  // namespace seaglint

// Always-on check of an invariant; throws with the values given as detail.
#define SEAGLINT_CHECK(condition, detail) \
  ((condition) ? void(0) : ::seaglint::fail_check(#condition, __FILE__, __LINE__, (detail)))

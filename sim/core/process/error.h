// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The two ways a run can fail, and the check for programmer errors.

#include <stdexcept>
#include <string>

namespace seaglint {

// The user's input is wrong; the program exits with 2. The message names file:line:col, key path, value and bound where
// there are any.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The input is right but the work failed (disk full, no permission); the program exits with 1.
class WorkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The user pressed Ctrl-C; the program exits with 1 and leaves nothing half-written.
class Interrupted : public WorkError {
 public:
  Interrupted() : WorkError("interrupted") {}
};

[[noreturn]] void fail_check(const char* condition, const char* file, int line, const std::string& detail);

}  // namespace seaglint

// Always-on check of what only a programming error can break; prints the values given as detail.
#define SEAGLINT_CHECK(condition, detail) \
  ((condition) ? void(0) : ::seaglint::fail_check(#condition, __FILE__, __LINE__, (detail)))

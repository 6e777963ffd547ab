// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Errors: wrong input, failed work, interruption; and the check for programmer errors.

#include <stdexcept>
#include <string>

namespace seaglint {

// Wrong user input; exit code 2. The message names file:line:col, key path, value and bound where they exist.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

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

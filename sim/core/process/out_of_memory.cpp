// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/out_of_memory.h"

#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

namespace seaglint {

namespace {

// Allocates nothing.
[[noreturn]] void end_program() {
  try {
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc&) {
    constexpr std::string_view kLine = "seaglint: out of memory\n";
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kLine.data(), kLine.size());
    ::_exit(1);
  } catch (...) {
  }
  std::abort();
}

}  // namespace

void report_uncaught_bad_alloc() { std::set_terminate(&end_program); }

}  // namespace seaglint

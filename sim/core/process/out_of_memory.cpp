// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/out_of_memory.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "sim/core/process/error.h"

namespace seaglint {

void require_address_space(std::size_t bytes, const std::string& what) {
  void* mapped = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED) {
    throw WorkError(fmt::format(
        "out of memory: {} needs {} MB more (the limit is that of `ulimit -v`, or the machine's)", what, bytes >> 20));
  }
  ::munmap(mapped, bytes);
}

namespace {

[[noreturn]] void end_out_of_memory() {
  constexpr std::string_view kLine = "seaglint: out of memory\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kLine.data(), kLine.size());
  ::_exit(1);
}

// Where there is no memory for an exception either, the program ends without one (Itanium C++ ABI, 2.4.2).
bool is_exhausted() {
  constexpr std::size_t kExceptionBytes = 256;
  void* volatile block = std::malloc(kExceptionBytes);
  const bool exhausted = block == nullptr;
  std::free(block);
  return exhausted;
}

[[noreturn]] void end_program() {
  try {
    if (std::current_exception()) throw;
    if (is_exhausted()) end_out_of_memory();
  } catch (const std::bad_alloc&) {
    end_out_of_memory();
  } catch (...) {
  }
  std::abort();
}

}  // namespace

void report_uncaught_bad_alloc() { std::set_terminate(&end_program); }

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/address_space.h"

#include <fmt/format.h>
#include <sys/mman.h>

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

}  // namespace seaglint

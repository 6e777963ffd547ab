// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/error.h"

#include <fmt/format.h>

namespace seaglint {

void fail_check(const char* condition, const char* file, int line, const std::string& detail) {
  throw std::logic_error(fmt::format("{}:{}: internal check failed: {} ({})", file, line, condition, detail));
}

}  // namespace seaglint

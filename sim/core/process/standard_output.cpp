// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/standard_output.h"

#include <cstdio>
#include <string>

#include "sim/core/process/printable.h"

namespace seaglint {

void print_text(std::string_view text) { std::fputs(printable(text).c_str(), stdout); }

}  // namespace seaglint

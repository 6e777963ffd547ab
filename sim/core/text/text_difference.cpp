// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/text_difference.h"

#include <fmt/format.h>

#include <sstream>

namespace seaglint {

std::string first_difference(const std::string& there, const std::string& here) {
  std::istringstream a(there), b(here);
  for (int line = 1;; ++line) {
    std::string left, right;
    const bool more_left = static_cast<bool>(std::getline(a, left));
    const bool more_right = static_cast<bool>(std::getline(b, right));
    if (!more_left && !more_right) return "the ends of the lines differ";
    if (left != right) return fmt::format("line {}: `{}` there, `{}` here", line, left, right);
  }
}

}  // namespace seaglint

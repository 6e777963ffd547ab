// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Results on standard output.

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace seaglint {

// Prints the text as printable() returns it. Failures are found when standard output is flushed at the end.
void print_text(std::string_view text);

// The same for the values in a format.
template <class... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
  print_text(fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace seaglint

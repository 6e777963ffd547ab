// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/shown.h"

#include <fmt/format.h>

#include "sim/core/process/printable.h"

namespace seaglint {

std::string shown(std::string_view text, std::size_t longest) { return on_one_line(text, longest); }

std::string in_quotes(std::string_view text) { return fmt::format("'{}'", shown(text)); }

}  // namespace seaglint

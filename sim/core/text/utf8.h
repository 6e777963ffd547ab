// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

namespace seaglint {

// Bytes of the text before the first that is not UTF-8 (RFC 3629); its whole length where all is.
std::size_t utf8_prefix(std::string_view text);

}  // namespace seaglint

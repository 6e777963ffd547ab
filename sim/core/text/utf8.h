// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace seaglint {

// Bytes of the text before the first that is not UTF-8 (RFC 3629); its whole length where all is.
std::size_t utf8_prefix(std::string_view text);

// The text as UTF-8: what is none already is taken as Latin-1.
std::string utf8_of(std::string_view text);

}  // namespace seaglint

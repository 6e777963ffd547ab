// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Values of the nodes of a scenario's document.

#include <cstdint>
#include <optional>
#include <string>

#include "sim/scenario/files/document.h"

namespace seaglint {

// A value as shown in error messages: "value 'x'", "a list".
std::string value_text(const YamlNode& node);

// A scalar without quotes.
bool is_plain(const YamlNode& node);

// The whole number of a plain scalar; nothing for any other node.
std::optional<std::int64_t> integer_of(const YamlNode& node);

// Letters, digits, '_' and '-' of ASCII.
bool is_name_character(char c);

}  // namespace seaglint

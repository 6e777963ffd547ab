// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Suggestions for misspelt words.

#include <string>
#include <string_view>
#include <vector>

namespace seaglint {

// "did you mean 'pulses'?" for the nearest of the names, or "must be one of a, b, c" when none is near.
std::string suggestion(std::string_view misspelt, const std::vector<std::string>& names);

}  // namespace seaglint

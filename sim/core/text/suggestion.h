// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Suggestions for misspelt words.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seaglint {

// The nearest of the names by edit distance, ignoring case; nothing when none is within a third of the letters.
std::optional<std::string> nearest(std::string_view misspelt, const std::vector<std::string>& names);

// "did you mean 'pulses'?" for the names that a word means, or "must be one of a, b, c" when none is near: the nearest
// with or without a unit at its end ("bandwidth" and "bandwidth_hz" mean "bandwidth_mhz"), else up to four that begin
// with the word or contain it ("hop" means "hop_count", "hop_step_mhz" or "hop_code").
std::string suggestion(std::string_view misspelt, const std::vector<std::string>& names);

// suggestion() where one or several names are near, else nothing.
std::optional<std::string> near_suggestion(std::string_view misspelt, const std::vector<std::string>& names);

}  // namespace seaglint

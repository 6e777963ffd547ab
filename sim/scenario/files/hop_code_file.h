// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Hop code read from a file of carrier numbers.

#include <filesystem>
#include <string>
#include <vector>

namespace seaglint {

// Whole numbers from 0 to carriers - 1, separated by spaces, tabs, commas, semicolons or line ends; comments as in
// text_source.h. Throws InputError "file:line:column: what" for anything else, for fewer than `pulses` numbers, and for
// a count that is not a multiple of `pulses`.
std::vector<int> read_hop_code(const std::filesystem::path& file, int pulses, int carriers);
std::vector<int> parse_hop_code(const std::string& text, const std::string& file_name, int pulses, int carriers);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Hop code read from a file of carrier numbers.

#include <filesystem>
#include <string>
#include <vector>

namespace seaglint {

// Whole numbers from 0 to carriers - 1 in any notation ("3", "3.", "3.000e+00"), separated by spaces, tabs, commas,
// semicolons, brackets or line ends; comments as in text_source.h, and MATLAB's captions "Columns 1 through 13". Throws
// InputError "file:line:column: what" for anything else, for fewer than `pulses` numbers, and for a count that is not a
// multiple of `pulses`; a file that counts from 1 is named.
std::vector<int> read_hop_code(const std::filesystem::path& file, int pulses, int carriers);
std::vector<int> parse_hop_code(const std::string& text, const std::string& file_name, int pulses, int carriers);

}  // namespace seaglint

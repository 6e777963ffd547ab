// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// SHA-256 (FIPS 180-4) of files and strings, as 64 lower-case hexadecimal digits.

#include <filesystem>
#include <string>
#include <string_view>

namespace seaglint {

std::string sha256(std::string_view bytes);
std::string sha256_file(const std::filesystem::path& file);  // the errors of read_file()

}  // namespace seaglint

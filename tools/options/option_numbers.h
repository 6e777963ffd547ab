// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Decimal numbers on the command line. Each function returns the error text of an option's value, "" if it is valid.

#include <string>

namespace seaglint {

std::string number_error(const std::string& text);
std::string number_error(const std::string& text, double lowest, double highest);  // NaN is outside all bounds

// For integers and for those of 0 or more; replace a valid text by the shortest decimal digits of the same value.
std::string rewrite_integer(std::string& text);
std::string rewrite_natural_number(std::string& text);

}  // namespace seaglint

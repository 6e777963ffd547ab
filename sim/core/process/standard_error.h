// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Messages on standard error; a failure to print them is never an error.

#include <string>

namespace seaglint {

// Prints the text on standard error; does nothing when it is closed or full.
void print_error(const std::string& text);

// Opens /dev/null on those of the standard streams 0 to 2 that are closed at program start, whose numbers the next
// opened file would otherwise take. Writing to a closed standard output still fails afterwards; text for a closed
// standard error is discarded.
void reserve_standard_streams();

}  // namespace seaglint

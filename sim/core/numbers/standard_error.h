// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What is said beside the results. Nobody's work fails because it cannot be shown.

#include <string>

namespace seaglint {

// Prints the text on standard error; one that is closed or full is passed over in silence.
void print_error(const std::string& text);

// A number of standard streams, 0 to 2, may be closed when the program starts, and the first file that it opens would
// take their place. Afterwards none is: what is written to standard output then still fails, standard error goes
// nowhere.
void reserve_standard_streams();

// A sentence on one line: control characters in it are written as escapes.
std::string on_one_line(const std::string& text);

}  // namespace seaglint

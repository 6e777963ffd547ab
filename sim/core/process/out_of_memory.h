// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The end of a program that has no memory where no exception can be caught.

namespace seaglint {

// A std::bad_alloc that nothing catches (in the constructor of a library's static object, in a thread of a library)
// prints one line and ends the program with exit code 1; any other exception ends it as before. May be called before
// the C++ library is initialised.
void report_uncaught_bad_alloc();

}  // namespace seaglint

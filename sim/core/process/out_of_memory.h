// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Lack of memory that no exception reports: libraries that end the process or wait for ever.

#include <cstddef>
#include <string>

namespace seaglint {

// Throws WorkError "out of memory: WHAT needs N MB more ..." unless the process may still map so many bytes; nothing
// stays reserved.
void require_address_space(std::size_t bytes, const std::string& what);

// A std::bad_alloc that nothing catches (in the constructor of a library's static object, in a thread of a library)
// prints one line and ends the program with exit code 1; any other exception ends it as before. May be called before
// the C++ library is initialised.
void report_uncaught_bad_alloc();

}  // namespace seaglint

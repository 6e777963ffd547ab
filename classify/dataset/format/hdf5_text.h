// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Text that HDF5 writes and reads in forms of its own: descriptions of errors and names of the sources of virtual
// arrays.

#include <string>
#include <string_view>

namespace seaglint {

// The system error in the description of an HDF5 error, ": No space left on device"; "" if it has none.
std::string system_reason(std::string_view description);

bool says_no_memory(std::string_view description);

// Replaces every `from` by `to` in a name: HDF5 interprets %b in a name as a block number, %% as a percent sign.
std::string with_percents(const std::string& name, std::string_view from, std::string_view to);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Every key a scenario may have, with its default and what it allows, from the one list of fields.

#include <string>

namespace seaglint {

// Every key with its default and what it allows, one line each.
std::string list_keys();

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// List of all scenario keys.

#include <string>

namespace seaglint {

// All keys with default and allowed values, one line each, from the list of fields.
std::string list_keys();

}  // namespace seaglint

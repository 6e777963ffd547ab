// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What every key of a scenario means.

#include <string_view>

namespace seaglint {

// A sentence with the unit of the key (key_list.h has the keys). The key must be one of the list.
std::string_view meaning_of(std::string_view key);

}  // namespace seaglint

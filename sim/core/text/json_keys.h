// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace seaglint {

// Throws InputError "NAME: the key 'x' appears twice in an object" for a JSON text with such a key, of which parsers
// keep either value; also for one that is nested more than 64 levels deep, of which the library's output takes stack at
// every level, and for objects of more than max_keys keys. Accepts texts that are no JSON: they are their parser's to
// refuse.
void check_json(std::string_view json, const std::string& name,
                std::size_t max_keys = std::numeric_limits<std::size_t>::max());

// Most keys of an object that is read as nlohmann::ordered_json, which searches all of them for each.
inline constexpr std::size_t kMaxOrderedKeys = 1000;

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace seaglint {

// Throws InputError "NAME: the key 'x' appears twice in an object" for a JSON text with such a key,
// of which parsers keep either value. Accepts texts that are no JSON: they are their parser's to refuse.
void refuse_repeated_keys(std::string_view json, const std::string& name);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// JSON of untrusted files: keys that stand twice, numbers, errors of the library in one line.

#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <nlohmann/json_fwd.hpp>
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

// A number in JSON, which has no NaN and no infinity: null where it is not finite.
nlohmann::ordered_json number_or_null(double value);

// The member `key` of an object, which the library would read of -1 as a huge number and of 4.7 as 4. Throws InputError
// "NAME: key: 4.7: must be a whole number" for those and what else is none from 0 on; the library's exception when the
// member is missing.
std::uint64_t whole_number(const nlohmann::ordered_json& object, const char* key, const std::string& name);

// Error of a JSON text (nlohmann::json::exception) in one line for users: the position of a syntax error, without a
// copy of the text there (possibly megabytes), or what was expected, without the error numbers of the library.
std::string json_problem(const std::exception& error);

}  // namespace seaglint

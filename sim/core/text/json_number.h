// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/core/process/error.h"
#include "sim/core/text/shown.h"

namespace seaglint {

// A number in JSON, which has no NaN and no infinity: null where it is not finite.
inline nlohmann::ordered_json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

// The member `key` of an object, which the library would read of -1 as a huge number and of 4.7 as 4. Throws InputError
// "NAME: key: 4.7: must be a whole number" for those and what else is none from 0 on; the library's exception when the
// member is missing.
inline std::uint64_t whole_number(const nlohmann::ordered_json& object, const char* key, const std::string& name) {
  const nlohmann::ordered_json& value = object.at(key);
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  throw InputError(fmt::format("{}: {}: {}: must be a whole number", name, key, shown(value.dump())));
}

}  // namespace seaglint

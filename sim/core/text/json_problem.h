// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

namespace seaglint {

// Error of a JSON text in one line for users: the position of a syntax error, without a copy of the text there
// (possibly megabytes), or what was expected, without the error numbers of the library.
inline std::string json_problem(const nlohmann::json::exception& error) {
  if (const auto* broken = dynamic_cast<const nlohmann::json::parse_error*>(&error))
    return fmt::format("no valid JSON from byte {} on", broken->byte);
  const std::string text = error.what();
  const std::size_t end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

namespace seaglint {

// After a parse that failed: the first word that no chosen command knows, an option or a command in a command's place,
// with what it may have been meant to be, as a message; nothing where every word is known. CLI11 speaks of what is
// missing first.
std::optional<std::string> unknown_word(const CLI::App& app);

}  // namespace seaglint

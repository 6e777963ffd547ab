// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

namespace seaglint {

// After a failed parse: a message that names the first word that is no option or subcommand of the chosen command, with
// its new name or the closest valid word; nothing if every word is valid. CLI11 itself reports missing arguments before
// unknown words.
std::optional<std::string> unknown_word(const CLI::App& app);

}  // namespace seaglint

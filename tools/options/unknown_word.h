// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace seaglint {

// A command after a failed parse.
struct CommandWords {
  std::string command;                         // "mesh make ship"; "" = the program
  std::vector<std::string> options, commands;  // that it has: "--output"; "ship"
  std::vector<std::string> rest;               // words of the command line that are none of these and no value
};

// A message that names the first word that is no option or subcommand of the command, with its new name or the closest
// valid word; nothing if every word is valid. CLI11 itself reports missing arguments before unknown words.
std::optional<std::string> unknown_word(const CommandWords& words);

}  // namespace seaglint

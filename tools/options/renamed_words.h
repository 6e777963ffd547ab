// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Options, their values and commands of earlier versions: what each is called now. None is accepted under its old name.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace seaglint {

struct RenamedWord {
  std::string_view command;    // that the option or command belongs to, as "mesh make ship"; "" = the program
  std::string_view word, now;  // an option with its dashes, or a command
};

struct RenamedOptionValue {
  std::string_view option, value, now;
};

std::span<const RenamedWord> renamed_words();
std::span<const RenamedOptionValue> renamed_option_values();

// "renamed to NEW" for an old option or command; nothing for other words.
std::optional<std::string> renamed_word(std::string_view command, std::string_view word);

// "value 'OLD': renamed to 'NEW'" for an old value of an option; "" for other values.
std::string renamed_value_error(std::string_view option, std::string_view value);

}  // namespace seaglint

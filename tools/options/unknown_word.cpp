// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options/unknown_word.h"

#include <fmt/format.h>

#include "sim/core/text/suggestion.h"
#include "tools/options/renamed_words.h"

namespace seaglint {
namespace {

// The list of all options is long: --help has it.
std::string unknown_option(const CommandWords& words, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  if (const auto renamed = renamed_word(words.command, name))
    return fmt::format("unknown option '{}': {}", name, *renamed);
  const std::optional<std::string> meant = near_suggestion(name, words.options);
  return fmt::format("unknown option '{}'{}", name, meant ? ": " + *meant : "");
}

}  // namespace

std::optional<std::string> unknown_word(const CommandWords& words) {
  for (const std::string& word : words.rest) {
    if (word.starts_with('-')) return unknown_option(words, word);
    if (words.commands.empty()) continue;
    const std::optional<std::string> renamed = renamed_word(words.command, word);
    return fmt::format("unknown command '{}': {}", word, renamed ? *renamed : suggestion(word, words.commands));
  }
  return std::nullopt;
}

}  // namespace seaglint

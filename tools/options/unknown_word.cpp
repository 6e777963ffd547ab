// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options/unknown_word.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "sim/core/text/suggestion.h"
#include "tools/options/renamed_words.h"

namespace seaglint {
namespace {

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

// The words of a command below the program's name: "mesh make ship"; "" of the program.
std::string command_of(const CLI::App& app) {
  if (app.get_parent() == nullptr) return "";
  const std::string before = command_of(*app.get_parent());
  return before.empty() ? app.get_name() : before + " " + app.get_name();
}

// The list of all options is long: --help has it.
std::string unknown_option(const CLI::App& app, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  if (const auto renamed = renamed_word(command_of(app), name))
    return fmt::format("unknown option '{}': {}", name, *renamed);
  const std::string meant = suggestion(name, option_names(app));
  return fmt::format("unknown option '{}'{}", name, meant.starts_with("did you mean") ? ": " + meant : "");
}

}  // namespace

std::optional<std::string> unknown_word(const CLI::App& app) {
  const std::vector<std::string> commands = command_names(app);
  for (const std::string& word : app.remaining()) {
    if (word.starts_with('-')) return unknown_option(app, word);
    if (commands.empty()) continue;
    const std::optional<std::string> renamed = renamed_word(command_of(app), word);
    return fmt::format("unknown command '{}': {}", word, renamed ? *renamed : suggestion(word, commands));
  }
  for (const CLI::App* chosen : app.get_subcommands()) {
    if (const std::optional<std::string> found = unknown_word(*chosen)) return found;
  }
  return std::nullopt;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options/command_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/text/names.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

std::string or_quotes(const std::string& text) { return text.empty() ? "''" : text; }

// For integers and for those of 0 or more; replace a valid text by the shortest decimal digits of the same value. These
// functions return the error text of an option's value, "" if it is valid.
template <class Whole>
std::string rewrite_whole(std::string& text, const std::optional<Whole>& value, const char* bound) {
  if (!value) return fmt::format("value {}: must be a whole number{}", or_quotes(text), bound);
  text = fmt::format("{}", *value);
  return "";
}

std::string number_error(const std::string& text) {
  return parse_number(text) ? "" : fmt::format("value {}: must be a number", or_quotes(text));
}

std::string number_error(const std::string& text, double lowest, double highest) {
  const std::optional<double> value = parse_number(text);
  const bool inside = value && *value >= lowest && *value <= highest;
  return inside ? "" : fmt::format("value {}: must be within {} and {}", or_quotes(text), lowest, highest);
}

std::string rewrite_integer(std::string& text) { return rewrite_whole(text, parse_integer(text), ""); }
std::string rewrite_natural_number(std::string& text) {
  return rewrite_whole(text, parse_natural(text), ", 0 or more");
}

std::vector<CLI::App*> subcommands(CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

// CLI11 alone reads numbers as C literals: 010 as eight, 0x10 as sixteen, an empty word as zero.
void require_decimal_numbers(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();
    if (type.starts_with("INT")) option->transform(CLI::Validator(rewrite_integer, ""));
    if (type.starts_with("UINT")) option->transform(CLI::Validator(rewrite_natural_number, ""));
    if (type.starts_with("FLOAT")) {
      // After an option's own bounds, whose error text is more specific.
      option->check([](const std::string& text) { return number_error(text); });
    }
  }
  for (CLI::App* subcommand : subcommands(command)) require_decimal_numbers(*subcommand);
}

// A command after a failed parse.
struct CommandWords {
  std::string command;                         // "mesh make ship"; "" = the program
  std::vector<std::string> options, commands;  // that it has: "--output"; "ship"
  std::vector<std::string> rest;               // words of the command line that are none of these and no value
};

// The list of all options is long: --help has it.
std::string unknown_option(const CommandWords& words, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  const std::optional<std::string> meant = near_suggestion(name, words.options);
  return fmt::format("unknown option '{}'{}", name, meant ? ": " + *meant : "");
}

// A message that names the first word that is no option or subcommand of the command, with the closest valid word;
// nothing if every word is valid. CLI11 itself reports missing arguments before unknown words.
std::optional<std::string> unknown_word(const CommandWords& words) {
  for (const std::string& word : words.rest) {
    if (word.starts_with('-')) return unknown_option(words, word);
    if (words.commands.empty()) continue;
    return fmt::format("unknown command '{}': {}", word, suggestion(word, words.commands));
  }
  return std::nullopt;
}

// The words of a command below the program's name: "mesh make ship"; "" of the program.
std::string words_of(const CLI::App& command) {
  if (command.get_parent() == nullptr) return "";
  const std::string before = words_of(*command.get_parent());
  return before.empty() ? command.get_name() : before + " " + command.get_name();
}

const CLI::App* given_subcommand(const CLI::App& command) {
  const std::vector<CLI::App*> given = command.get_subcommands();
  return given.empty() ? nullptr : given.front();
}

// The error text of the first unknown word, of the command or of the subcommands given.
std::optional<std::string> unknown_word_below(CLI::App& command) {
  CommandWords words{words_of(command), {}, {}, command.remaining()};
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) words.options.push_back("--" + name);
  }
  for (const CLI::App* subcommand : subcommands(command)) words.commands.push_back(subcommand->get_name());
  if (std::optional<std::string> found = unknown_word(words)) return found;
  for (CLI::App* given : command.get_subcommands()) {
    if (std::optional<std::string> found = unknown_word_below(*given)) return found;
  }
  return std::nullopt;
}

}  // namespace

CommandOption CommandOption::required() {
  option_->required();
  return *this;
}

CommandOption CommandOption::needs(const CommandOption& other) {
  option_->needs(other.option_);
  return *this;
}

bool CommandOption::given() const { return option_->count() > 0; }

CommandOption CommandOption::show_default() {
  option_->capture_default_str();
  return *this;
}

CommandOption CommandOption::group(const std::string& heading) {
  option_->group(heading);
  return *this;
}

CommandOption CommandOption::repeatable(const std::string& value_name) {
  option_->type_name(value_name);
  if (!option_->get_positional()) option_->allow_extra_args(false);
  return *this;
}

CommandOption CommandOption::comma_separated(int count) {
  option_->delimiter(',')->expected(count);
  return *this;
}

CommandOption CommandOption::integer_within(int lowest, int highest) {
  option_->check(CLI::Range(lowest, highest));
  return *this;
}

CommandOption CommandOption::number_within(double lowest, double highest) {
  option_->check([=](const std::string& text) { return number_error(text, lowest, highest); },
                 fmt::format("within {} and {}", lowest, highest));
  return *this;
}

CommandOption CommandOption::one_of(const std::vector<std::string>& values) {
  option_->check(CLI::IsMember(values));
  return *this;
}

CommandOption CommandOption::check(const ErrorText& error_text) {
  option_->check(error_text);
  return *this;
}

CommandOptions CommandOptions::add_command(const std::string& name, const std::string& what) {
  return CommandOptions(command_->add_subcommand(name, what));
}

void CommandOptions::require_command() { command_->require_subcommand(1); }

void CommandOptions::footer(const std::string& text) { command_->footer(text); }

void CommandOptions::callback(const std::function<void()>& call) { command_->callback(call); }

CommandOption CommandOptions::add_option(const std::string& names, std::string& value, const std::string& what) {
  return CommandOption(command_->add_option(names, value, what));
}

CommandOption CommandOptions::add_option(const std::string& names, int& value, const std::string& what) {
  return CommandOption(command_->add_option(names, value, what));
}

CommandOption CommandOptions::add_option(const std::string& names, std::size_t& value, const std::string& what) {
  return CommandOption(command_->add_option(names, value, what));
}

CommandOption CommandOptions::add_option(const std::string& names, double& value, const std::string& what) {
  return CommandOption(command_->add_option(names, value, what));
}

CommandOption CommandOptions::add_option(const std::string& names, std::optional<double>& value,
                                         const std::string& what) {
  return CommandOption(command_->add_option(names, value, what));
}

CommandOption CommandOptions::add_option(const std::string& names, std::vector<double>& values,
                                         const std::string& what) {
  return CommandOption(command_->add_option(names, values, what));
}

CommandOption CommandOptions::add_option(const std::string& names, std::array<double, 3>& values,
                                         const std::string& what) {
  const auto parse = [&values, names](const std::string& text) {
    std::array<double, 3> read{};
    std::size_t begin = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t end = i < 2 ? text.find(',', begin) : text.size();
      const std::optional<double> number =
          end == std::string::npos ? std::nullopt : parse_number(std::string_view(text).substr(begin, end - begin));
      if (!number || !std::isfinite(*number))
        throw CLI::ValidationError(names, fmt::format("value {}: must be three numbers X,Y,Z", text));
      read[i] = *number;
      begin = end + 1;
    }
    values = read;
  };
  return CommandOption(command_->add_option_function<std::string>(names, parse, what)->type_name("X,Y,Z"));
}

CommandOption CommandOptions::add_option(const std::string& names, std::vector<std::string>& values,
                                         const std::string& what) {
  return CommandOption(command_->add_option(names, values, what));
}

CommandOption CommandOptions::add_flag(const std::string& names, bool& value, const std::string& what) {
  return CommandOption(command_->add_flag(names, value, what));
}

void CommandOptions::require_any_of(const std::string& option, const std::vector<std::string>& others) const {
  const auto given = [this](const std::string& name) { return command_->count(name) > 0; };
  if (given(option) && std::none_of(others.begin(), others.end(), given))
    throw CLI::RequiresError(option, fmt::format("{}", fmt::join(others, " or ")));
}

void CommandOptions::require_one_of(const std::vector<std::string>& options) const {
  if (std::none_of(options.begin(), options.end(),
                   [this](const std::string& name) { return command_->count(name) > 0; }))
    throw CLI::RequiredError(fmt::format("{}", fmt::join(options, " or ")));
}

void CommandOptions::refuse_with(const std::string& option, const std::vector<std::string>& others) const {
  for (const std::string& other : others) {
    if (command_->count(option) > 0 && command_->count(other) > 0) throw CLI::ExcludesError(option, other);
  }
}

ProgramOptions::ProgramOptions(const std::string& name, const std::string& what)
    : CommandOptions(nullptr), program_(std::make_unique<CLI::App>(what, name)) {
  command_ = program_.get();
}

ProgramOptions::~ProgramOptions() = default;

void ProgramOptions::set_version(const std::string& text) { program_->set_version_flag("--version", text); }

ParsedCommandLine ProgramOptions::parse(int argc, const char* const* argv) {
  require_decimal_numbers(*program_);
  try {
    program_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      std::ostringstream text;
      program_->exit(error, text);
      return {text.str(), std::nullopt};
    }
    const CLI::App* last = program_.get();
    while (const CLI::App* given = given_subcommand(*last)) last = given;
    std::string chosen = words_of(*last);
    if (!chosen.empty()) chosen.insert(0, " ");
    return {std::nullopt, fmt::format("{} (see {}{} --help)", unknown_word_below(*program_).value_or(error.what()),
                                      program_->get_name(), chosen)};
  }
  return {};
}

CommandOption add_style_option(CommandOptions& command, std::string& style) {
  return command
      .add_option("--style", style,
                  "Of figures: screen, or for print, .png with 300 dots per inch: paper 88 mm wide, paper-wide 180 mm")
      .one_of({"screen", "paper", "paper-wide"})
      .show_default();
}

void add_time_options(CommandOptions& command, double& duration_s, double& step_s) {
  command.add_option("--duration-s", duration_s, "Length of the series").show_default().number_within(0, 1e6);
  command.add_option("--step-s", step_s, "Time between its rows").show_default().number_within(1e-4, 1e4);
}

std::size_t uniform_time_count(double duration_s, double step_s) {
  constexpr double kMaxCount = 1e7;
  const double steps = std::floor(duration_s / step_s + 1e-9);
  if (steps >= kMaxCount) {
    throw InputError(fmt::format("--duration-s {} with --step-s {}: {:.3g} rows: must be at most {:.0e}", duration_s,
                                 step_s, steps + 1, kMaxCount));
  }
  return static_cast<std::size_t>(steps) + 1;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The commands of a program with their options and positional arguments: declaration, help text, parsing, error texts.
// Only command_options.cpp includes CLI11, whose templates cost several seconds per source.

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace seaglint {

// One option or positional argument of a command. Every function returns the option, so that calls chain; a value
// that violates a restriction is refused with the option's name.
class CommandOption {
 public:
  using ErrorText = std::function<std::string(const std::string& value)>;  // "" = valid

  explicit CommandOption(CLI::Option* option) : option_(option) {}

  CommandOption required();
  CommandOption needs(const CommandOption& other);  // is refused without the other one
  bool given() const;                               // for callbacks: the command line has it
  CommandOption show_default();                     // the help text gives the variable's present value
  CommandOption group(const std::string& heading);  // of the help text

  // One value per occurrence, any number of positional ones; the help text names them.
  CommandOption repeatable(const std::string& value_name);
  CommandOption comma_separated(int count);  // a list of `count` values
  CommandOption integer_within(int lowest, int highest);
  CommandOption number_within(double lowest, double highest);  // refuses NaN
  CommandOption one_of(const std::vector<std::string>& values);
  CommandOption check(const ErrorText& error_text);

 private:
  CLI::Option* option_;
};

// The options and subcommands of a command, or of the program itself. Copies refer to the same command, which lives as
// long as its ProgramOptions. Numbers are decimal.
class CommandOptions {
 public:
  explicit CommandOptions(CLI::App* command) : command_(command) {}

  CommandOptions add_command(const std::string& name, const std::string& what);
  void require_command();  // one of the subcommands must be given
  void footer(const std::string& text);
  void callback(const std::function<void()>& call);  // called at the end of parsing if the command was given

  // An option ("-o,--output") or a positional argument ("SCENARIO"): parsing writes its value into the variable.
  CommandOption add_option(const std::string& names, std::string& value, const std::string& what);
  CommandOption add_option(const std::string& names, int& value, const std::string& what);
  CommandOption add_option(const std::string& names, std::size_t& value, const std::string& what);
  CommandOption add_option(const std::string& names, double& value, const std::string& what);
  CommandOption add_option(const std::string& names, std::optional<double>& value, const std::string& what);
  CommandOption add_option(const std::string& names, std::vector<double>& values, const std::string& what);
  CommandOption add_option(const std::string& names, std::array<double, 3>& values, const std::string& what);  // X,Y,Z
  CommandOption add_option(const std::string& names, std::vector<std::string>& values, const std::string& what);
  CommandOption add_flag(const std::string& names, bool& value, const std::string& what);

  // For callbacks: refuses an option that is given without any of the others.
  void require_any_of(const std::string& option, const std::vector<std::string>& others) const;
  // For callbacks: refuses a command line with none of the options, and one with the option and any of the others.
  void require_one_of(const std::vector<std::string>& options) const;
  void refuse_with(const std::string& option, const std::vector<std::string>& others) const;

 protected:
  CLI::App* command_;
};

// --style of a command's figures, a name of figure_style().
CommandOption add_style_option(CommandOptions& command, std::string& style);

// A command line that was parsed: at most one of the two members is set.
struct ParsedCommandLine {
  std::optional<std::string> information;  // what --help or --version asks for; no command is to be run
  std::optional<std::string> error;        // why the command line is refused, and where --help is found
};

// The program with all its commands.
class ProgramOptions : public CommandOptions {
 public:
  ProgramOptions(const std::string& name, const std::string& what);
  ~ProgramOptions();

  void set_version(const std::string& text);  // of --version
  ParsedCommandLine parse(int argc, const char* const* argv);

 private:
  std::unique_ptr<CLI::App> program_;
};

// Times of a command that writes a time series.

// Adds --duration-s and --step-s; the present values are the defaults.
void add_time_options(CommandOptions& command, double& duration_s, double& step_s);

// Number of times 0, step, ... up to the duration, including the duration when it is within 1e-9 of a step. Throws
// InputError beyond ten million.
std::size_t uniform_time_count(double duration_s, double step_s);

}  // namespace seaglint

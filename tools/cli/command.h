// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The subcommands of `seaglint`, one file command_<verb>.cpp each, in the order of the data flow.

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// What every command is given: the stop flag of Ctrl-C, and the place where the chosen command leaves its work.
struct Shell {
  StopFlag stop{false};
  int threads = 0;             // --threads, 0 = all processors
  std::function<void()> work;  // set by the chosen command's callback, run by main
  bool one_piece = false;      // the work never looks at `stop`: Ctrl-C ends it at once
};

// Each adds its command to the program, with a footer that shows an example; listed in main.cpp too.
void add_check(CLI::App& app, Shell& shell);
void add_keys(CLI::App& app, Shell& shell);
void add_mesh(CLI::App& app, Shell& shell);
void add_sea(CLI::App& app, Shell& shell);
void add_motion(CLI::App& app, Shell& shell);
void add_rcs(CLI::App& app, Shell& shell);
void add_echo(CLI::App& app, Shell& shell);
void add_map(CLI::App& app, Shell& shell);
void add_generate(CLI::App& app, Shell& shell);
void add_merge(CLI::App& app, Shell& shell);
void add_verify(CLI::App& app, Shell& shell);
void add_remake(CLI::App& app, Shell& shell);
void add_export(CLI::App& app, Shell& shell);
void add_train(CLI::App& app, Shell& shell);
void add_run(CLI::App& app, Shell& shell);
void add_report(CLI::App& app, Shell& shell);

// A number of the interval; unlike CLI::Range it refuses NaN.
CLI::Validator number_within(double lowest, double highest);

// Holds every option of numbers, of all commands below too, to decimal numbers.
void require_decimal_numbers(CLI::App& app);

// Throws CLI11's error for an option that is given with none of those that it belongs to.
void require_any_of(const CLI::App& command, const std::string& option, const std::vector<std::string>& others);

// The data set in a directory: there, or in the `data` below it that `run` makes.
std::filesystem::path find_data_set(const std::filesystem::path& directory);

// Before any work: every file that a command is going to write can be written (WorkError), and none is another of them
// or one that the command reads (InputError). Empty names are none.
void require_outputs(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs);

// The files that a scenario names.
std::vector<std::filesystem::path> files_of(const Scenario& scenario);

// Adds --threads to a command.
void add_threads_option(CLI::App& command, Shell& shell);

// The values of --set, `key.path=value` each. Throws InputError for one without `=`.
std::vector<Override> read_overrides(const std::vector<std::string>& set);

// Adds the positional SCENARIO and the repeatable --set key.path=value to a command, and reads them.
struct ScenarioArguments {
  std::string file;
  std::vector<std::string> set;
  Scenario read() const;  // throws InputError
};
void add_scenario_arguments(CLI::App& command, ScenarioArguments& arguments);

}  // namespace seaglint

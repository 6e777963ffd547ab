// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The command line of seaglint: its subcommands in the order of the data flow, and the arguments that several of them
// share.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"
#include "tools/options/command_options.h"

namespace seaglint {

struct FieldTable;
struct ReferenceArguments;

// Parses a command line and runs its command. Returns the exit code: 0 (done), 1 (the work failed) or 2 (the input is
// wrong); 1 and 2 with the reason as one line on stderr.
int run_command_line(int argc, char** argv);

// State shared by all commands: the stop flag of Ctrl-C, the thread count, and the work of the chosen command.
struct CommandContext {
  StopFlag stop{false};
  int threads = 0;               // --threads, 0 = all processors
  std::function<void()> work;    // set by the chosen command's callback, run by run_command_line
  bool uninterruptible = false;  // the work never checks `stop`: Ctrl-C ends the process at once
};

// Each adds its command to the program, with an example in the footer of its help: files command_*.cpp, one of each
// subject.
void add_check(CommandOptions& program, CommandContext& context);
void add_keys(CommandOptions& program, CommandContext& context);
void add_init(CommandOptions& program, CommandContext& context);
void add_paths(CommandOptions& program, CommandContext& context);
void add_mesh(CommandOptions& program, CommandContext& context);
void add_sea(CommandOptions& program, CommandContext& context);
void add_motion(CommandOptions& program, CommandContext& context);
void add_rcs(CommandOptions& program, CommandContext& context);
void add_compare(CommandOptions& program, CommandContext& context);
void add_echo(CommandOptions& program, CommandContext& context);
void add_map(CommandOptions& program, CommandContext& context);
void add_generate(CommandOptions& program, CommandContext& context);
void add_merge(CommandOptions& program, CommandContext& context);
void add_verify(CommandOptions& program, CommandContext& context);
void add_regenerate(CommandOptions& program, CommandContext& context);
void add_look(CommandOptions& program, CommandContext& context);
void add_features(CommandOptions& program, CommandContext& context);
void add_export(CommandOptions& program, CommandContext& context);
void add_train(CommandOptions& program, CommandContext& context);
void add_evaluate(CommandOptions& program, CommandContext& context);
void add_classify(CommandOptions& program, CommandContext& context);
void add_run(CommandOptions& program, CommandContext& context);
void add_benchmark(CommandOptions& program, CommandContext& context);
void add_report(CommandOptions& program, CommandContext& context);

// Directory of the data set: the given one, its `data`, where `run` writes it, or that of a merged file's shards.
std::filesystem::path find_data_set(const std::filesystem::path& directory);

// Directory of the model: the given one, or its `model`, where `run` writes it.
std::filesystem::path find_model(const std::filesystem::path& directory);

// Adds --threads to a command.
void add_threads_option(CommandOptions& command, CommandContext& context);

// Parses the values of --set, `key.path=value` each. Throws InputError for one without `=`.
std::vector<Override> read_overrides(const std::vector<std::string>& set);

// Adds the positional SCENARIO and the repeatable --set key.path=value to a command, and reads them.
struct ScenarioArguments {
  std::string file;
  std::vector<std::string> set;
  Scenario read() const;  // throws InputError
};
void add_scenario_arguments(CommandOptions& command, ScenarioArguments& arguments);

// The tables of `rcs --reference` and of `compare`; on standard error a line on how each was read. Throws InputError.
std::vector<FieldTable> read_and_report(const ReferenceArguments& files);

// Checks of input and output files before a command's work.

// Throws WorkError if an output cannot be written, InputError if two outputs are one file or an output is an input.
// Empty names are skipped.
void require_outputs(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs);

// The files that a scenario names.
std::vector<std::filesystem::path> files_of(const Scenario& scenario);

}  // namespace seaglint

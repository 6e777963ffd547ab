// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The subcommands of `seaglint`, one file command_<verb>.cpp each, in the order of the data flow.

#include <functional>

#include "sim/core/process/parallel.h"
#include "tools/options/command_options.h"

namespace seaglint {

// State shared by all commands: the stop flag of Ctrl-C, the thread count, and the work of the chosen command.
struct CommandContext {
  StopFlag stop{false};
  int threads = 0;               // --threads, 0 = all processors
  std::function<void()> work;    // set by the chosen command's callback, run by run_command_line
  bool uninterruptible = false;  // the work never checks `stop`: Ctrl-C ends the process at once
};

// Each adds its command to the program, with an example in the footer of its help; command_line.cpp calls them.
void add_check(CommandOptions& program, CommandContext& context);
void add_keys(CommandOptions& program, CommandContext& context);
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
void add_features(CommandOptions& program, CommandContext& context);
void add_export(CommandOptions& program, CommandContext& context);
void add_card(CommandOptions& program, CommandContext& context);
void add_train(CommandOptions& program, CommandContext& context);
void add_evaluate(CommandOptions& program, CommandContext& context);
void add_classify(CommandOptions& program, CommandContext& context);
void add_run(CommandOptions& program, CommandContext& context);
void add_benchmark(CommandOptions& program, CommandContext& context);
void add_report(CommandOptions& program, CommandContext& context);

}  // namespace seaglint

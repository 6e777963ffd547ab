// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The subcommands of `seaglint`, one file command_<verb>.cpp each, in the order of the data flow.

#include <CLI/App.hpp>
#include <functional>

#include "sim/core/process/parallel.h"

namespace seaglint {

// State shared by all commands: the stop flag of Ctrl-C, the thread count, and the work of the chosen command.
struct CommandContext {
  StopFlag stop{false};
  int threads = 0;               // --threads, 0 = all processors
  std::function<void()> work;    // set by the chosen command's callback, run by run_command_line
  bool uninterruptible = false;  // the work never checks `stop`: Ctrl-C ends the process at once
};

// Each adds its command to the program, with an example in the footer of its help; command_line.cpp calls them.
void add_check(CLI::App& app, CommandContext& shell);
void add_keys(CLI::App& app, CommandContext& shell);
void add_mesh(CLI::App& app, CommandContext& shell);
void add_sea(CLI::App& app, CommandContext& shell);
void add_motion(CLI::App& app, CommandContext& shell);
void add_rcs(CLI::App& app, CommandContext& shell);
void add_echo(CLI::App& app, CommandContext& shell);
void add_map(CLI::App& app, CommandContext& shell);
void add_generate(CLI::App& app, CommandContext& shell);
void add_merge(CLI::App& app, CommandContext& shell);
void add_verify(CLI::App& app, CommandContext& shell);
void add_regenerate(CLI::App& app, CommandContext& shell);
void add_export(CLI::App& app, CommandContext& shell);
void add_train(CLI::App& app, CommandContext& shell);
void add_run(CLI::App& app, CommandContext& shell);
void add_report(CLI::App& app, CommandContext& shell);

}  // namespace seaglint

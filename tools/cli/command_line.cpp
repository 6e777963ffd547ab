// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cli/command_line.h"

#include <fmt/format.h>
#include <signal.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>

#include "seaglint_version.h"
#include "sim/core/numbers/standard_error.h"
#include "sim/core/process/error.h"
#include "tools/cli/command.h"
#include "tools/options/option_numbers.h"
#include "tools/options/unknown_word.h"

namespace seaglint {

namespace {

// Signal handlers can access static storage only.
StopFlag* stop_flag = nullptr;

void request_stop(int) { *stop_flag = true; }

// A write beyond the file size limit then fails with an error, as on a full disk, instead of ending the process.
void survive_file_size_limit() { signal(SIGXFSZ, SIG_IGN); }

// The first Ctrl-C sets the stop flag and removes the handler, so that the second one ends the process.
void handle_signals(CommandContext& shell) {
  stop_flag = &shell.stop;
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

// In the order of the data flow.
void add_commands(CLI::App& app, CommandContext& shell) {
  add_check(app, shell);
  add_keys(app, shell);
  add_mesh(app, shell);
  add_sea(app, shell);
  add_motion(app, shell);
  add_rcs(app, shell);
  add_echo(app, shell);
  add_map(app, shell);
  add_generate(app, shell);
  add_merge(app, shell);
  add_verify(app, shell);
  add_regenerate(app, shell);
  add_export(app, shell);
  add_train(app, shell);
  add_run(app, shell);
  add_report(app, shell);
}

int fail(int code, const std::string& message) {
  std::fflush(stdout);
  print_error(fmt::format("seaglint: {}\n", on_one_line(message)));
  return code;
}

// 0, or 1 if a write to standard output failed.
int end_output() {
  std::cout.flush();
  if (std::cout && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return 0;
  return fail(1, fmt::format("standard output: cannot write: {}", std::strerror(errno)));
}

// The words that select a command: " mesh make sphere".
std::string chosen_words(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? "" : " " + chosen.front()->get_name() + chosen_words(*chosen.front());
}

// CLI11 prints --help and --version; every other parse error is wrong input.
int end_parsing(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    app.exit(error);
    return end_output();
  }
  const std::string message = unknown_word(app).value_or(error.what());
  return fail(2, fmt::format("{} (see seaglint{} --help)", message, chosen_words(app)));
}

int run(CommandContext& shell) {
  try {
    shell.work();
    return end_output();
  } catch (const InputError& error) {
    return fail(2, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(1, fmt::format("{}: {}", error.path1().string(), error.code().message()));
  } catch (const std::bad_alloc&) {
    return fail(1, "out of memory");
  } catch (const std::exception& error) {
    return fail(1, error.what());
  }
}

}  // namespace

int run_command_line(int argc, char** argv) {
  reserve_standard_streams();
  CommandContext shell;
  CLI::App app(
      "Ships and corner-reflector decoys at sea as a frequency-agile radar sees them: from a scenario to classified "
      "maps",
      "seaglint");
  app.set_version_flag("--version", fmt::format("seaglint {}", kVersion));
  app.require_subcommand(1);
  app.footer("Example:\n  seaglint check scenarios/quick.yaml\n\nEvery command has --help with an example.");
  add_commands(app, shell);
  require_decimal_numbers(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return end_parsing(app, error);
  }
  survive_file_size_limit();
  if (!shell.uninterruptible) handle_signals(shell);
  return run(shell);
}

}  // namespace seaglint

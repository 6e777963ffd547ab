// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "sim/core/error.h"
#include "tools/command.h"
#include "tools/report.h"

namespace seaglint {

void add_report(CLI::App& app, Shell& shell) {
  CLI::App* command = app.add_subcommand("report", "Draw the figures of a run again and write its report.html");
  auto directory = std::make_shared<std::string>();
  command->add_option("DIR", *directory, "Directory made by `seaglint run`")->required();
  add_threads_option(*command, shell);
  command->footer("Example:\n  seaglint report build/demo");
  command->callback([directory, &shell] {
    shell.work = [directory, &shell] {
      const std::filesystem::path run = *directory;
      const std::filesystem::path scenario = run / "scenario.yaml";
      if (!std::filesystem::exists(scenario)) {
        throw InputError(fmt::format("{}: not the directory of a run: no scenario.yaml", run.string()));
      }
      write_report(run, read_scenario(scenario), shell.threads, &shell.stop);
      fmt::print("Report: {}\n", (run / kReportFile).string());
    };
  });
}

}  // namespace seaglint

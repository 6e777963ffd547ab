// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "classify/dataset/directory/dataset_writer.h"
#include "sim/core/process/error.h"
#include "sim/core/process/standard_output.h"
#include "sim/core/text/text_difference.h"
#include "sim/scenario/writer.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/report/report.h"

namespace seaglint {

namespace {

// The scenario of the run; throws if it is not that of the data set, as figures and text would then disagree.
Scenario read_own_scenario(const std::filesystem::path& run) {
  const std::filesystem::path file = run / "scenario.yaml", of_data = run / "data" / kScenarioFile;
  if (!std::filesystem::exists(file))
    throw InputError(fmt::format("{}: not the directory of a run: no scenario.yaml", run.string()));
  if (!std::filesystem::exists(of_data)) {
    const std::filesystem::path above = (run / "..").lexically_normal(),
                                place = run.has_filename() ? run.filename() : run.parent_path().filename();
    const bool is_data = place == "data" && std::filesystem::exists(above / "scenario.yaml");
    throw InputError(fmt::format("{}: not the directory of a run: {}", run.string(),
                                 is_data
                                     ? fmt::format("it is the data set of {}",
                                                   above.has_filename() ? above.string() : above.parent_path().string())
                                     : "no data/scenario.yaml"));
  }
  Scenario scenario = read_scenario(file);
  const std::string here = effective_yaml(scenario), there = effective_yaml(read_scenario(of_data));
  if (here != there) {
    throw InputError(fmt::format("{}: is not the scenario of {} ({}); bring the run's own back", file.string(),
                                 of_data.string(), first_difference(there, here)));
  }
  return scenario;
}

}  // namespace

void add_report(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command("report", "Draw the figures of a run again and write its report.html");
  auto directory = std::make_shared<std::string>();
  command.add_option("DIR", *directory, "Directory made by `seaglint run`").required();
  add_threads_option(command, context);
  command.footer("Example:\n  seaglint report build/demo");
  command.callback([directory, &context] {
    context.work = [directory, &context] {
      const std::filesystem::path run = *directory;
      write_report(run, read_own_scenario(run), context.threads, &context.stop);
      print_out("Report: {}\n", (run / kReportFile).string());
    };
  });
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>
#include <memory>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/model/study.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/scenario/scenario.h"
#include "tools/cli/command_line.h"
#include "tools/report/report.h"
#include "tools/run/benchmark.h"
#include "tools/run/run.h"

namespace seaglint {

namespace {

struct RunArguments {
  ScenarioArguments scenario;
  std::string directory;
  bool resume = false;
};

}  // namespace

void add_run(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("run", "The main job: make the maps of a scenario, train, evaluate, write the report");
  auto arguments = std::make_shared<RunArguments>();
  add_scenario_arguments(command, arguments->scenario);
  command.add_option("-o,--output", arguments->directory, "Directory of the results, new or empty").required();
  command.add_flag("--resume", arguments->resume, "Go on with what an earlier run left in the directory");
  add_threads_option(command, context);
  command.footer("Example:\n  seaglint run scenarios/points.yaml -o build/points-run");
  command.callback([arguments, &context] {
    context.work = [arguments, &context] {
      const Scenario scenario = arguments->scenario.read();
      try {
        const RunResult run =
            run_scenario(scenario, arguments->directory, {arguments->resume, context.threads}, &context.stop);
        print_out("{}\n{}", accuracy_table(run.study), run.times);
      } catch (const Interrupted&) {
        throw WorkError(fmt::format("interrupted; whole shards are kept, go on by the same command with --resume ({})",
                                    arguments->directory));
      }
    };
  });
}

namespace {

struct BenchmarkArguments {
  std::string name;
  std::string directory;
  std::vector<std::string> set;
  bool small = false;
  bool resume = false;
};

}  // namespace

void add_benchmark(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "benchmark", "Make a data set whose classes differ in motion alone, and evaluate the baselines on it");
  auto arguments = std::make_shared<BenchmarkArguments>();
  command.add_option("NAME", arguments->name, "Name of a scenario of scenarios/benchmark, or a scenario file (.yaml)")
      .required();
  command.add_option("-o,--output", arguments->directory, "Directory of the results, new or empty").required();
  command.add_flag("--small", arguments->small, "A trial with a few maps in a minute");
  command.add_option("--set", arguments->set, "Replace a value of the scenario (repeatable)")
      .repeatable("KEY.PATH=VALUE");
  command.add_flag("--resume", arguments->resume, "Go on with what an earlier run left in the directory");
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint benchmark rigid_twin --small -o build/rigid-twin\n"
      "  seaglint benchmark scenarios/paper.yaml --small -o build/paper");
  command.callback([arguments, &context] {
    context.work = [arguments, &context] {
      const Scenario scenario = read_benchmark(arguments->name, arguments->small, read_overrides(arguments->set));
      try {
        print_out("{}", run_benchmark(scenario, arguments->small, arguments->directory, arguments->resume,
                                      context.threads, &context.stop));
      } catch (const Interrupted&) {
        throw WorkError(fmt::format("interrupted; whole shards are kept, go on by the same command with --resume ({})",
                                    arguments->directory));
      }
    };
  });
}

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
  const Scenario stored = read_scenario(of_data);
  if (scenario != stored) {
    throw InputError(fmt::format("{}: is not the scenario of {} ({}); bring the run's own back", file.string(),
                                 of_data.string(), first_difference(effective_yaml(stored), effective_yaml(scenario))));
  }
  return scenario;
}

}  // namespace

void add_report(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command("report", "Draw the figures of a run again and write its report.html");
  auto directory = std::make_shared<std::string>();
  command.add_option("RUN", *directory, "Directory made by `seaglint run`; the report is written into it").required();
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

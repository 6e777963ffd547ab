// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>

#include "classify/model/study_text.h"
#include "sim/core/process/error.h"
#include "sim/core/process/standard_output.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/report/run.h"

namespace seaglint {

namespace {

struct Arguments {
  ScenarioArguments scenario;
  std::string directory;
  bool resume = false;
};

}  // namespace

void add_run(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("run", "The main job: make the maps of a scenario, train, evaluate, write the report");
  auto arguments = std::make_shared<Arguments>();
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

}  // namespace seaglint

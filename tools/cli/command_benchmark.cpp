// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "sim/core/process/error.h"
#include "sim/core/process/standard_output.h"
#include "tools/benchmark/benchmark.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"

namespace seaglint {

namespace {

struct Arguments {
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
  auto arguments = std::make_shared<Arguments>();
  command.add_option("NAME", arguments->name, "Name of a scenario of scenarios/benchmark, or a scenario file (.yaml)")
      .required();
  command.add_option("-o,--output", arguments->directory, "Directory of the results, new or empty").required();
  command.add_flag("--small", arguments->small, "A trial with a few maps in a minute");
  command.add_option("--set", arguments->set, "Replace a value of the scenario: key.path=value");
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

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Makes the maps and features of a data set again from its stored echoes.
#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "classify/dataset/directory/input_list.h"
#include "sim/core/process/error.h"
#include "sim/core/process/standard_output.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/pipeline/generate.h"
#include "tools/pipeline/stored_echoes.h"

namespace seaglint {

namespace {

struct Arguments {
  std::string data;
  std::vector<std::string> set;
  std::string directory;
  bool resume = false;
};

void make_features(const Arguments& arguments, const CommandContext& context) {
  const DatasetReader reader(find_data_set(arguments.data));
  const std::filesystem::path file = reader.directory() / kScenarioFile;
  const Scenario stored = read_scenario(file);
  const StoredEchoes echoes(reader);
  require_same_inputs(reader.directory(), stored);
  const Pipeline pipeline(read_scenario(file, read_overrides(arguments.set)));
  require_same_echoes(pipeline, stored);

  GenerateOptions options;
  options.resume = arguments.resume;
  options.threads = context.threads;
  options.response = [&](std::size_t sample, const PulseTrain& train) { return echoes.response(sample, train); };
  const auto begin = std::chrono::steady_clock::now();
  GenerateResult result;
  try {
    result = generate_dataset(pipeline, arguments.directory, options, &context.stop);
  } catch (const Interrupted&) {
    throw WorkError(fmt::format("interrupted; whole shards are kept, go on by the same command with --resume ({})",
                                arguments.directory));
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  print_out("{}: {} maps made from stored echoes in {:.1f} s, {} kept\n", arguments.directory, result.made, seconds,
            result.kept);
}

}  // namespace

void add_features(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "features", "Make the maps and features of a data set again from its stored echoes, with other settings");
  auto arguments = std::make_shared<Arguments>();
  command.add_option("data", arguments->data, "Directory of a data set with dataset.echoes: true").required();
  command.add_option("--set", arguments->set, "Replace a value of clutter, map, features or learning, key.path=value")
      .repeatable("KEY.PATH=VALUE");
  command.add_option("-o,--output", arguments->directory, "Directory of the new data set, new or empty").required();
  command.add_flag("--resume", arguments->resume, "Keep the sound shards that are there; also starts a new directory");
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint generate scenarios/points.yaml --set dataset.echoes=true -o build/points\n"
      "  seaglint features build/points --set clutter.scr_db=10 --set features.max_centres=32 -o build/points_10");
  command.callback(
      [arguments, &context] { context.work = [arguments, &context] { make_features(*arguments, context); }; });
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Makes the data set of a scenario, or maps and features again from the stored echoes of one.
#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "classify/dataset/directory/input_list.h"
#include "sim/core/process/error.h"
#include "sim/core/process/standard_output.h"
#include "sim/core/text/number.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/pipeline/generate.h"
#include "tools/pipeline/stored_echoes.h"
#include "tools/report/learnable.h"

namespace seaglint {

namespace {

struct Arguments {
  ScenarioArguments scenario;
  std::string directory;
  std::string part;
  bool resume = false;
};

// "2/5": the second of five parts.
void read_part(const std::string& text, GenerateOptions& options) {
  const std::size_t slash = text.find('/');
  const auto number = [&](std::size_t begin, std::size_t end) {
    const std::int64_t value = parse_integer(std::string_view(text).substr(begin, end - begin)).value_or(0);
    return value >= 0 && value <= 1000000 ? static_cast<int>(value) : 0;
  };
  if (slash != std::string::npos) {
    options.part = number(0, slash);
    options.parts = number(slash + 1, text.size());
  }
  if (slash == std::string::npos || options.part < 1 || options.parts < options.part || options.parts < 1) {
    throw InputError(fmt::format("--part: {}: must be I/N with 1 <= I <= N, for example 1/4", text));
  }
}

// Makes the maps and says how many; `from`: of what, " from ..." or empty.
void make_data_set(const Pipeline& pipeline, const std::string& directory, const GenerateOptions& options,
                   const CommandContext& context, const char* from) {
  const auto begin = std::chrono::steady_clock::now();
  GenerateResult result;
  try {
    result = generate_dataset(pipeline, directory, options, &context.stop);
  } catch (const Interrupted&) {
    throw WorkError(
        fmt::format("interrupted; whole shards are kept, go on by the same command with --resume ({})", directory));
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  print_out("{}: {} maps made{} in {:.1f} s, {} kept\n", directory, result.made, from, seconds, result.kept);
  if (result.missing > 0)
    print_out("{} shards of other parts are still missing or damaged; the last part writes the manifest\n",
              result.missing);
}

void generate(const Arguments& arguments, const CommandContext& context) {
  GenerateOptions options;
  options.resume = arguments.resume;
  options.threads = context.threads;
  if (!arguments.part.empty()) read_part(arguments.part, options);
  const Scenario scenario = arguments.scenario.read();
  check_division(scenario, SamplePlan(scenario));
  make_data_set(Pipeline(scenario), arguments.directory, options, context, "");
}

struct FeaturesArguments {
  std::string data;
  std::vector<std::string> set;
  std::string directory;
  bool resume = false;
};

void make_features(const FeaturesArguments& arguments, const CommandContext& context) {
  const DatasetReader reader(find_data_set(arguments.data));
  const std::filesystem::path file = reader.directory() / kScenarioFile;
  const Scenario stored = read_scenario(file);
  const StoredEchoes echoes(reader);
  require_same_inputs(reader.directory(), stored);
  const Pipeline pipeline(read_scenario(file, read_overrides(arguments.set)));
  require_same_echoes(pipeline, stored);
  check_division(pipeline.scenario(), pipeline.plan());
  GenerateOptions options;
  options.resume = arguments.resume;
  options.threads = context.threads;
  options.response = [&](std::size_t sample, const PulseTrain& train) { return echoes.response(sample, train); };
  make_data_set(pipeline, arguments.directory, options, context, " from stored echoes");
}

}  // namespace

void add_generate(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "generate", "Make the data set of a scenario: range-velocity maps with labels in HDF5 shards");
  auto arguments = std::make_shared<Arguments>();
  add_scenario_arguments(command, arguments->scenario);
  command.add_option("-o,--output", arguments->directory, "Directory of the data set, new or empty").required();
  command.add_option("--part", arguments->part, "Make the I-th of N parts (whole shards), as I/N");
  command.add_flag("--resume", arguments->resume, "Keep the sound shards that are there; also starts a new directory");
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint generate scenarios/points.yaml -o build/points\n"
      "  seaglint generate scenarios/paper.yaml -o build/paper --part 3/16 --resume");
  command.callback([arguments, &context] { context.work = [arguments, &context] { generate(*arguments, context); }; });
}

void add_features(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "features", "Make the maps and features of a data set again from its stored echoes, with other settings");
  auto arguments = std::make_shared<FeaturesArguments>();
  command.add_option("data", arguments->data, "Directory of a data set with dataset.echoes: true").required();
  command.add_option("--set", arguments->set, "Replace a value of clutter, map, features or learning, key.path=value")
      .repeatable("KEY.PATH=VALUE");
  command.add_option("-o,--output", arguments->directory, "Directory of the new data set, new or empty").required();
  command.add_flag("--resume", arguments->resume, "Keep the sound shards that are there; also starts a new directory");
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint features build/points --set clutter.scr_db=10 --set features.max_centres=32 -o "
      "build/points_10\n"
      "of a data set that was made with --set dataset.echoes=true");
  command.callback(
      [arguments, &context] { context.work = [arguments, &context] { make_features(*arguments, context); }; });
}

}  // namespace seaglint

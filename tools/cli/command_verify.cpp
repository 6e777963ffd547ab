// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>

#include "classify/dataset/directory/audit.h"
#include "classify/dataset/directory/input_list.h"
#include "sim/core/process/error.h"
#include "sim/core/process/progress.h"
#include "sim/core/process/standard_output.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/pipeline/regenerate.h"

namespace seaglint {

namespace {

struct Arguments {
  std::string directory;
  int regenerate = 2;
};

// Regenerates `count` samples, spread evenly over the data set; returns what is not as stored.
std::vector<std::string> regenerate(const std::string& directory, std::size_t count, const Scenario& scenario,
                                    const CommandContext& context) {
  const DatasetReader reader(directory);
  require_same_inputs(directory, scenario);
  const Pipeline pipeline(scenario);
  std::vector<std::vector<std::string>> faults(count);
  std::mutex reading;  // HDF5 serves one thread at a time
  Progress progress("regenerating samples", count);
  parallel_for(
      count, thread_count(context.threads),
      [&](std::size_t n) {
        const std::size_t number = (2 * n + 1) * reader.size() / (2 * count);
        const SampleAddress address = pipeline.plan().address(number);
        StoredSample stored;
        {
          const std::lock_guard lock(reading);
          stored = stored_sample(reader, number);
        }
        const Sample again = pipeline.generate_sample(number).stored;
        for (const std::string& what : differences(stored.sample, again, reproduction_tolerance(stored.origin))) {
          faults[n].push_back(fmt::format("sample {} ({}) regenerated: {}", number,
                                          scenario.targets[static_cast<std::size_t>(address.target)].name, what));
        }
        progress.advance();
      },
      &context.stop);
  std::vector<std::string> all;
  for (const auto& some : faults) all.insert(all.end(), some.begin(), some.end());
  return all;
}

void verify(const Arguments& given, const CommandContext& context) {
  const Arguments arguments{find_data_set(given.directory), given.regenerate};
  Audit result = audit(arguments.directory, &context.stop);
  print_out("{}: {} sound shards, {} samples in {} groups\n", arguments.directory, result.shards, result.samples,
            result.groups);
  for (std::size_t t = 0; t < result.per_target.size(); ++t) {
    const TargetSpec& target = result.scenario.targets[t];
    print_out("  {:<12} label {}  {} samples\n", target.name, target.label, result.per_target[t]);
  }
  const std::size_t count = std::min(static_cast<std::size_t>(arguments.regenerate), result.samples);
  if (result.faults.empty() && count > 0) {
    result.faults = regenerate(arguments.directory, count, result.scenario, context);
    if (result.faults.empty())
      print_out("{} regenerated samples match the stored ones, SCR and features included\n", count);
  }
  if (result.faults.empty()) {
    print_out("no fault found\n");
    return;
  }
  constexpr std::size_t kMaxShown = 20;
  for (std::size_t i = 0; i < std::min(kMaxShown, result.faults.size()); ++i)
    print_out("fault: {}\n", result.faults[i]);
  if (result.faults.size() > kMaxShown) print_out("... and {} more\n", result.faults.size() - kMaxShown);
  throw InputError(
      fmt::format("{}: {} faults, the first: {}", arguments.directory, result.faults.size(), result.faults.front()));
}

}  // namespace

void add_verify(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "verify", "Audit a data set: missing, repeated, damaged and mislabelled samples; regenerates some of them");
  auto arguments = std::make_shared<Arguments>();
  command.add_option("directory", arguments->directory, "Directory of the data set").required();
  command
      .add_option("--regenerate", arguments->regenerate,
                  "Samples to regenerate from their rows, spread over the data set")
      .integer_within(0, 1000000)
      .show_default();
  add_threads_option(command, context);
  command.footer("Example:\n  seaglint verify build/demo/data --regenerate 5");
  command.callback([arguments, &context] { context.work = [arguments, &context] { verify(*arguments, context); }; });
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>

#include "classify/dataset/directory/audit.h"
#include "classify/dataset/directory/input_list.h"
#include "sim/core/process/error.h"
#include "sim/core/process/progress.h"
#include "sim/core/process/standard_output.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/pipeline/regenerate.h"
#include "tools/pipeline/sample_cross_check.h"

namespace seaglint {

namespace {

struct Arguments {
  std::string directory;
  int regenerate = 2;
  int cross_check = 0;
  std::optional<double> cross_check_db;  // bound of the median
};

// Regenerates `count` samples, spread evenly over the data set; returns what is not as stored.
std::vector<std::string> regenerate(const std::string& directory, std::size_t count, const Scenario& scenario,
                                    const CommandContext& context) {
  const DatasetReader reader(directory);
  require_same_inputs(directory, scenario);
  const Pipeline pipeline(scenario);
  const std::vector<std::size_t> samples = evenly_spread(count, reader.size());
  std::vector<std::vector<std::string>> faults(count);
  std::mutex reading;  // HDF5 serves one thread at a time
  Progress progress("regenerating samples", count);
  parallel_for(
      count, thread_count(context.threads),
      [&](std::size_t n) {
        const std::size_t number = samples[n];
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

// Reports how far samples differ by the other method of the solver.
void cross_check(const Arguments& arguments, const Audit& audited, const CommandContext& context) {
  const std::size_t count = std::min(static_cast<std::size_t>(arguments.cross_check), audited.samples);
  if (count == 0) return;
  require_same_inputs(arguments.directory, audited.scenario);
  const SampleCrossCheck check =
      cross_check_samples(audited.scenario, evenly_spread(count, audited.samples), context.threads, &context.stop);
  print_out("{}", text_of(check));
  if (!arguments.cross_check_db) return;
  if (check.differences.empty())
    throw InputError(fmt::format("{}: --cross-check-db: none of {} samples has a solver", arguments.directory, count));
  if (check.median_response_db() > *arguments.cross_check_db) {
    throw WorkError(fmt::format("{}: the median relative difference of the response, {:.1f} dB, is above {:g} dB",
                                arguments.directory, check.median_response_db(), *arguments.cross_check_db));
  }
}

void verify(const Arguments& given, const CommandContext& context) {
  Arguments arguments = given;
  arguments.directory = find_data_set(given.directory);
  Audit result = audit(arguments.directory, &context.stop);
  print_out("{}: {} sound shards, {} samples in {} groups\n", arguments.directory, result.shards, result.samples,
            result.groups);
  for (std::size_t t = 0; t < result.per_target.size(); ++t) {
    const TargetSpec& target = result.scenario.targets[t];
    if (target.role == TargetRole::kPart) continue;
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
    cross_check(arguments, result, context);
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
  const CommandOption cross_check =
      command
          .add_option("--cross-check", arguments->cross_check,
                      "Samples, spread evenly over the data set, whose response is also computed by the other method "
                      "of the solver: rays for beams, beams for rays (auto: beams and rays); reports the differences")
          .integer_within(0, 1000000)
          .show_default();
  command
      .add_option("--cross-check-db", arguments->cross_check_db,
                  "Exit code 1 when the median relative difference of these responses is above this, dB; without it "
                  "differences are reported only")
      .number_within(-300.0, 300.0)
      .needs(cross_check);
  add_threads_option(command, context);
  command.footer("Example:\n  seaglint verify build/demo/data --regenerate 5");
  command.callback([arguments, &context] { context.work = [arguments, &context] { verify(*arguments, context); }; });
}

}  // namespace seaglint

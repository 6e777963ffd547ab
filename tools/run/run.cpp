// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/run.h"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/model/division.h"
#include "classify/model/study.h"
#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tools/figure/figure.h"
#include "tools/pipeline/generate.h"
#include "tools/pipeline/train.h"
#include "tools/pipeline/warnings.h"
#include "tools/report/finding.h"
#include "tools/report/report.h"

namespace seaglint {

namespace {

std::vector<RowGroup> planned_seas(const SamplePlan& plan) {
  std::vector<RowGroup> seas;
  for (std::size_t sample = 0; sample < plan.size(); ++sample) {
    const SampleAddress address = plan.sea_address(sample);
    seas.push_back({plan.group(address), address.sea_state});
  }
  return seas;
}

// Calls check(), whose errors get the place of a key.
template <class Check>
auto at_key(const Scenario& scenario, const std::string& key, Check&& check) {
  try {
    return check();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", place_of(scenario, key), error.what()));
  }
}

// Whether the values of a column are known before the maps: those of the scenario, and drawn ones; not the number of
// the data set.
bool is_planned(const std::string& name) {
  if (name == "data_set") return false;
  const auto is_name = [&](const SampleColumn& column) { return name == column.name; };
  return std::ranges::any_of(planned_columns(), is_name) || std::ranges::none_of(sample_columns(), is_name);
}

}  // namespace

void check_division(const Scenario& scenario, const SamplePlan& plan) {
  const SplitSpec& split = scenario.learning.split;
  const DivisionRequest request = division_request(split);
  if (request.is_default() || is_sea_alone(scenario)) return;
  std::vector<DataRow> rows;
  std::vector<int> labels;
  for (std::size_t sample = 0; sample < plan.size(); ++sample) {
    rows.push_back({0, planned_record(scenario, plan, sample)});
    labels.push_back(static_cast<int>(rows.back().record.label));
  }
  bool all_planned = is_planned(split.by);
  at_key(scenario, "learning.split.by", [&] { return column_of(rows, split.by); });
  for (const HoldOutSpec& held : split.hold_out) {
    at_key(scenario, "learning.split.hold_out." + held.column, [&] { return column_of(rows, held.column); });
    all_planned = all_planned && is_planned(held.column);
  }
  if (!all_planned) return;
  at_key(scenario, "learning.split", [&] {
    const Division division = make_division(rows, planned_seas(plan), labels, request);
    require_classes(division, labels, scenario);
    check_splits(division, scenario.learning, scenario.dataset.train_fraction, scenario.seed);
  });
}

void check_learnable(const Scenario& scenario, const SamplePlan& plan) {
  if (is_sea_alone(scenario)) {
    throw InputError(
        fmt::format("{}: the sea alone: learning needs targets of two classes", place_of(scenario, "targets")));
  }
  const std::vector<std::string>& classes = scenario.dataset.classes;
  for (int label = 0; label < static_cast<int>(classes.size()); ++label) {
    const bool has = std::ranges::any_of(
        plan.classes(), [&](int target) { return scenario.targets[static_cast<std::size_t>(target)].label == label; });
    if (has) continue;
    if (classes.size() == 2) throw InputError("targets: learning needs a target of label 0 and one of label 1");
    throw InputError(fmt::format("{}: learning needs a target of every class, also of '{}' (label {})",
                                 place_of(scenario, "dataset.classes"), classes[static_cast<std::size_t>(label)],
                                 label));
  }
  if (division_request(scenario.learning.split).is_default()) {
    check_splits(division_by_sea(planned_seas(plan)), scenario.learning, scenario.dataset.train_fraction,
                 scenario.seed);
  }
  check_division(scenario, plan);
}

namespace fs = std::filesystem;

namespace {

// Wall-clock seconds of the stages, in order.
class StageClock {
 public:
  template <class Work>
  auto time(const std::string& stage, Work work) {
    const auto begin = std::chrono::steady_clock::now();
    struct Stop {
      StageClock& clock;
      std::string stage;
      std::chrono::steady_clock::time_point begin;
      ~Stop() { clock.add(stage, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()); }
    } stop{*this, stage, begin};
    return work();
  }

  void add(const std::string& stage, double seconds) { seconds_.emplace_back(stage, seconds); }

  const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }

 private:
  std::vector<std::pair<std::string, double>> seconds_;
};

// Throws InputError unless the directory is that of a run (with resume), or empty or absent.
void require_directory(const fs::path& directory, bool resume) {
  if (!is_there(directory)) return;
  std::error_code error;
  if (!fs::is_directory(directory, error))
    throw InputError(fmt::format("{}: is a file, not a directory", directory.string()));
  if (fs::is_empty(directory, error)) return;
  if (!resume) {
    throw InputError(
        fmt::format("{}: the directory is not empty; go on with what is there by --resume", directory.string()));
  }
  if (!fs::is_directory(directory / "data", error))
    throw InputError(fmt::format("{}: the directory contains something else than a run", directory.string()));
}

}  // namespace

RunResult run_scenario(const Scenario& scenario, const fs::path& directory, const RunOptions& options,
                       const StopFlag* stop) {
  const SamplePlan plan(scenario);
  check_learnable(scenario, plan);
  require_directory(directory, options.resume);
  require_gnuplot();

  StageClock clock;
  std::optional<Pipeline> pipeline;
  const GenerateResult made = clock.time("maps", [&] {
    pipeline.emplace(scenario, plan);
    return generate_dataset(*pipeline, directory / "data", {1, 1, true, options.threads}, stop);
  });
  ReportCollector collector(scenario, plan);
  TrainedModel model = clock.time("learning", [&] {
    return train_model({.data_sets = {directory / "data"},
                        .model_directory = directory / "model",
                        .scenario = &scenario,
                        .threads = options.threads,
                        .stop = stop,
                        .use = [&](const Shard& shard) { collector.add(shard); },
                        .scope = options.scope});
  });
  warn(model.warnings);

  write_file(directory / "scenario.yaml", effective_yaml(scenario));
  const Manifest manifest = DatasetReader(directory / "data").manifest();
  NetworkRecord network = record_of(*model.study.network);
  RunResults results{collector.with_embeddings(model.study.embeddings),
                     {std::move(model.study),
                      std::move(network),
                      {thread_count(options.threads), made.made, made.kept, clock.seconds()},
                      kVersion,
                      manifest.processors,
                      manifest.scenario_sha256}};
  write_report({directory, scenario, plan, pipeline->targets(), results, options.threads, stop});

  std::string text;
  for (const auto& [stage, seconds] : results.numbers.run.seconds)
    text += fmt::format("{:<10}{:8.1f} s\n", stage, seconds);
  if (made.kept > 0) text += fmt::format("{} of {} maps were there already\n", made.kept, made.kept + made.made);
  text +=
      fmt::format("\n{}\nReport: {}\n", finding(results.numbers.study, scenario), (directory / kReportFile).string());
  return {std::move(results.numbers.study), std::move(text)};
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/benchmark/benchmark.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/core/process/data_folder.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/suggestion.h"
#include "sim/scenario/sample_plan.h"
#include "tools/benchmark/benchmark_result.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFolder = "scenarios/benchmark";
constexpr int kSmallSeas = 6, kSmallIntervals = 2;  // of each sea state; of each sea

}  // namespace

std::vector<std::string> benchmark_names() {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(data_folder() / kFolder, error)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

Scenario read_benchmark(const std::string& name, bool small, const std::vector<Override>& overrides) {
  const std::vector<std::string> names = benchmark_names();
  if (std::ranges::find(names, name) == names.end()) {
    throw InputError(fmt::format("{}: no benchmark of this name; {}", name, suggestion(name, names)));
  }
  const fs::path file = data_folder() / kFolder / (name + ".yaml");
  std::vector<Override> all;
  if (small) {
    const int maps = kSmallSeas * kSmallIntervals * read_scenario(file).dataset.maps_per_interval;
    all = {{"dataset.realisations_per_case", std::to_string(kSmallSeas)},
           {"dataset.maps_per_case", std::to_string(maps)},
           {"learning.split_repeats", "2"}};
  }
  all.insert(all.end(), overrides.begin(), overrides.end());
  return read_scenario(file, all);
}

std::string run_benchmark(const std::string& name, bool small, const Scenario& scenario, const fs::path& directory,
                          const RunOptions& options, const StopFlag* stop) {
  const RunResult run = run_scenario(scenario, directory, options, stop);
  const SamplePlan plan(scenario);
  const std::size_t seas = plan.sea_states().size() * static_cast<std::size_t>(scenario.dataset.realisations_per_case);
  nlohmann::ordered_json json{{"benchmark", name},
                              {"small", small},
                              {"program_version", run.metrics.at("version")},
                              {"seed", scenario.seed},
                              {"maps", plan.size()},
                              {"seas", seas},
                              {"split_repeats", scenario.learning.split_repeats}};
  json.update(benchmark_json(run.study));
  write_file(directory / kBenchmarkFile, json.dump(2) + "\n");
  return fmt::format("{}\n{}\n{}\nFigures: {}\n", benchmark_text(run.study),
                     benchmark_row(name, plan.size(), seas, run.study), run.times,
                     (directory / kBenchmarkFile).string());
}

}  // namespace seaglint

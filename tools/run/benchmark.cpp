// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/benchmark.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/names.h"
#include "sim/scenario/sample_plan.h"
#include "tools/evaluate/claims.h"
#include "tools/report/metrics.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFolder = "scenarios/benchmark";
constexpr int kSmallSeas = 10, kSmallIntervals = 2;  // of each sea state; of each sea with one azimuth
constexpr std::size_t kSmallAzimuths = 5;

// The file of a benchmark's name, or a scenario of its own.
fs::path file_of(const std::string& name) {
  const std::vector<std::string> names = benchmark_names();
  if (std::ranges::find(names, name) != names.end()) return data_folder() / kFolder / (name + ".yaml");
  if (fs::path(name).extension() == ".yaml") return find_input(name, "scenarios");
  throw InputError(
      fmt::format("{}: no benchmark of this name, and no file NAME.yaml; {}", name, suggestion(name, names)));
}

// At most kSmallAzimuths values of a sweep, with its first and last.
Sweep thinned(const Sweep& values) {
  if (values.size() <= kSmallAzimuths) return values;
  Sweep some;
  for (std::size_t i = 0; i < kSmallAzimuths; ++i)
    some.push_back(values[i * (values.size() - 1) / (kSmallAzimuths - 1)]);
  return some;
}

std::vector<Override> small_overrides(const Scenario& scenario) {
  const Sweep azimuths = thinned(scenario.view.azimuth_deg);
  const int seas = std::min(kSmallSeas, scenario.dataset.realisations_per_case);
  const int intervals = azimuths.size() > 1 ? 1 : kSmallIntervals;
  std::vector<Override> overrides{
      {"dataset.realisations_per_case", std::to_string(seas)},
      {"dataset.maps_per_case", std::to_string(seas * intervals * scenario.dataset.maps_per_interval)},
      {"learning.split_repeats", "2"}};
  if (azimuths.size() < scenario.view.azimuth_deg.size())
    overrides.push_back({"view.azimuth_deg", fmt::format("[{}]", fmt::join(azimuths, ", "))});
  return overrides;
}

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
  const fs::path file = file_of(name);
  std::vector<Override> all;
  if (small) all = small_overrides(read_scenario(file));
  all.insert(all.end(), overrides.begin(), overrides.end());
  return read_scenario(file, all);
}

std::string run_benchmark(const Scenario& scenario, bool small, const fs::path& directory, bool resume, int threads,
                          const StopFlag* stop) {
  const RunResult run = run_scenario(scenario, directory, {resume, threads, StudyScope::kPrimary}, stop);
  const SamplePlan plan(scenario);
  const std::size_t seas = plan.sea_states().size() * static_cast<std::size_t>(scenario.dataset.realisations_per_case);
  const BenchmarkRecord record{scenario.name, small, scenario.seed, plan.size(), seas, scenario.learning.split_repeats};
  write_file(directory / kBenchmarkFile, benchmark_json(record, run.study));
  return fmt::format("{}\n{}\n{}\nFigures: {}\n", benchmark_text(run.study), benchmark_row(record, run.study),
                     run.times, (directory / kBenchmarkFile).string());
}

}  // namespace seaglint

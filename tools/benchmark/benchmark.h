// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A benchmark: a scenario of scenarios/benchmark/, its data set, the baselines, and one file with what they reach.
//   DIR/benchmark.json; DIR/report.html, metrics.json, data, model: as of `run`

#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"
#include "tools/report/run.h"

namespace seaglint {

inline constexpr const char* kBenchmarkFile = "benchmark.json";

// Names of the benchmarks that come with the program.
std::vector<std::string> benchmark_names();

// The scenario of a benchmark by name, changed by `overrides`. With `small` it has first 6 seas of each sea state with
// 2 intervals each, and learning.split_repeats 2: a trial in a minute, whose figures say little. Throws InputError for
// an unknown name, with the nearest one.
Scenario read_benchmark(const std::string& name, bool small, const std::vector<Override>& overrides);

// Makes the data set, trains and evaluates, and writes benchmark.json last. Returns the text for the terminal. Errors
// and `resume` as in run_scenario().
std::string run_benchmark(const std::string& name, bool small, const Scenario& scenario,
                          const std::filesystem::path& directory, const RunOptions& options,
                          const StopFlag* stop = nullptr);

}  // namespace seaglint

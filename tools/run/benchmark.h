// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A benchmark: a scenario, of scenarios/benchmark/ or another one of two classes, its data set, the baselines, and one
// file with what they reach.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"
#include "tools/run/run.h"

namespace seaglint {

// Files of a benchmark:
//   DIR/benchmark.json; DIR/report.html, metrics.json, data, model: as of `run`, without the random split of the maps
//   and the other fusion, of which benchmark.json has no figure

// Names of the benchmarks that come with the program.
std::vector<std::string> benchmark_names();

// The scenario of a benchmark by name, or of a file NAME.yaml, found as those of other commands are; changed by
// `overrides`. With `small` it has first at most 10 seas of each sea state with 2 intervals each, or with 1 where
// view.azimuth_deg is swept, over at most 5 of its azimuths, and learning.split_repeats 2: a trial in a minute, whose
// figures say little. Throws InputError for an unknown name, with the nearest one.
Scenario read_benchmark(const std::string& name, bool small, const std::vector<Override>& overrides);

// Makes the data set, trains and evaluates (StudyScope::kPrimary), and writes benchmark.json last. Returns the text for
// the terminal. Errors, `resume` and `threads` as in run_scenario().
std::string run_benchmark(const Scenario& scenario, bool small, const std::filesystem::path& directory, bool resume,
                          int threads, const StopFlag* stop = nullptr);

}  // namespace seaglint

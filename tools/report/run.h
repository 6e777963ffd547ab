// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The main job: data set, learning, evaluation and report of one scenario in one directory.
//   DIR/report.html, metrics.json, *.png, *.svg, scenario.yaml; DIR/data the data set; DIR/model the model

#include <filesystem>
#include <string>

#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

struct RunOptions {
  bool resume = false;
  int threads = 0;  // 0 = all processors
};

// Returns what the terminal should show at the end: the accuracy table, seconds per stage, where the report is. Without
// `resume` the directory must be new or empty.
std::string run_scenario(const Scenario& scenario, const std::filesystem::path& directory, const RunOptions& options,
                         const StopFlag* stop = nullptr);

}  // namespace seaglint

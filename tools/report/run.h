// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Complete run of one scenario in one directory: data set, learning, evaluation and report.
//   DIR/report.html, metrics.json, *.png, *.svg, scenario.yaml; DIR/data the data set; DIR/model the model

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "classify/model/study.h"
#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

struct RunOptions {
  bool resume = false;
  int threads = 0;  // 0 = all processors
  StudyScope scope = StudyScope::kFull;
};

struct RunResult {
  Study study;
  nlohmann::ordered_json metrics;  // as in metrics.json
  std::string times;               // seconds per stage, maps that were there already, path of the report
};

// Without `resume` the directory must be new or empty.
RunResult run_scenario(const Scenario& scenario, const std::filesystem::path& directory, const RunOptions& options,
                       const StopFlag* stop = nullptr);

}  // namespace seaglint

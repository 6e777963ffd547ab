// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Complete run of one scenario in one directory: data set, learning, evaluation and report; and what learning would
// reject, before any map is made.

#include <filesystem>
#include <string>

#include "classify/model/study.h"
#include "sim/core/process/parallel.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// Rejects, before any map is made, what learning would reject.

// Throws InputError with the place in the scenario file for a learning.split of an unknown column, one that leaves
// nothing, or one class only, to train or to test on, and values that no map has. Values of columns that are measured
// on the maps are not known before. Does nothing for the default, a division by sea. `plan` of the same scenario.
void check_division(const Scenario& scenario, const SamplePlan& plan);

// The same, and for targets of one class only, and too few seas for a division by sea.
void check_learnable(const Scenario& scenario, const SamplePlan& plan);

// Complete run of one scenario in one directory: data set, learning, evaluation and report.
//   DIR/report.html, metrics.json, *.png, *.svg, scenario.yaml; DIR/data the data set; DIR/model the model

struct RunOptions {
  bool resume = false;
  int threads = 0;  // 0 = all processors
  StudyScope scope = StudyScope::kFull;
};

struct RunResult {
  Study study;
  std::string times;  // seconds per stage, maps that were there already, finding(), path of the report
};

// Without `resume` the directory must be new or empty.
RunResult run_scenario(const Scenario& scenario, const std::filesystem::path& directory, const RunOptions& options,
                       const StopFlag* stop = nullptr);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The report of a run: one HTML page that needs nothing but itself, and its figures as PNG and SVG files beside it.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/sample_plan.h"
#include "tools/pipeline/scene.h"
#include "tools/report/report_data.h"

namespace seaglint {

inline constexpr const char* kReportFile = "report.html";

// What a run leaves in memory for its report.
struct RunResults {
  ReportData data;
  nlohmann::ordered_json metrics;  // of the model, with the member `run`
};

// Draws the figures, adds the numbers that only the report uses to metrics.json (member `report`), and writes
// report.html last; returns the seconds that it took. The targets are the scenario's.
double write_report(const std::filesystem::path& directory, const Scenario& scenario, const SamplePlan& plan,
                    const std::vector<Target>& targets, RunResults results, int threads,
                    const StopFlag* stop = nullptr);

// The same from DIR/metrics.json, DIR/data and DIR/model as `run` left them. `scenario` is the run's own; its targets
// are drawn where their files are found, else a warning says why not. Throws InputError for a directory that `run` did
// not make.
void write_report(const std::filesystem::path& directory, const Scenario& scenario, int threads,
                  const StopFlag* stop = nullptr);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The report of a run: one self-contained HTML page, and its figures as PNG and SVG files in the same directory.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/sample_plan.h"
#include "tools/pipeline/scene.h"
#include "tools/report/report_data.h"

namespace seaglint {

inline constexpr const char* kReportFile = "report.html";

// Results of a run that its report uses.
struct RunResults {
  ReportData data;
  nlohmann::ordered_json metrics;  // of the model, with the member `run`
};

// Draws the figures, adds the numbers that only the report uses to metrics.json (member `report`), and writes
// report.html last; returns the elapsed seconds. `targets` are those of the scenario.
double write_report(const std::filesystem::path& directory, const Scenario& scenario, const SamplePlan& plan,
                    const std::vector<Target>& targets, RunResults results, int threads,
                    const StopFlag* stop = nullptr);

// The same from DIR/metrics.json, DIR/data and DIR/model of a finished run. `scenario` is that of the run; its targets
// are drawn if their files are found, else a warning gives the reason. Throws InputError for a directory that is no
// finished run.
void write_report(const std::filesystem::path& directory, const Scenario& scenario, int threads,
                  const StopFlag* stop = nullptr);

}  // namespace seaglint

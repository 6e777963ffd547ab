// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The report of a run: one HTML page that needs nothing but itself, and its figures as PNG and SVG files beside it.

#include <filesystem>

#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

inline constexpr const char* kReportFile = "report.html";

// Reads DIR/metrics.json, DIR/data and DIR/model as `run` left them, draws the figures, adds the numbers that only the
// report uses to metrics.json (member `report`), and writes report.html last. `scenario` is the run's own; its targets
// are drawn where their files are found, else a warning says why not. Throws InputError for a directory that `run` did
// not make.
void write_report(const std::filesystem::path& directory, const Scenario& scenario, int threads,
                  const StopFlag* stop = nullptr);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The report of a run: one self-contained HTML page, and its figures as PNG and SVG files in the same directory; tables
// and sentences from the numbers of the run, in the places of report.html.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "classify/model/study.h"
#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"
#include "tools/report/explorer.h"
#include "tools/report/metrics.h"
#include "tools/report/report_data.h"
#include "tools/report/report_figures.h"

namespace seaglint {

inline constexpr const char* kReportFile = "report.html";

// The quantities that could reveal the class with their accuracies, and what these say (as_chance()), as HTML.
std::string probes_table(const Study& study, const Scenario& scenario);

// Accuracies of baselines and floor, in total and by wave height, and claims, as HTML; with a link to the benchmark's
// own report where its folder's name is an address.
std::string benchmark_section(const StoredBenchmark& benchmark);

// Everything on a page beside the numbers of the run.
struct PageParts {
  std::vector<ReportFigure> figures;
  HotSpots hot_spots;
  std::string missing;  // why no targets are drawn; empty: they are
  std::vector<StoredBenchmark> benchmarks;
};

// report.html with its text, without the page around it.
std::string report_body(const RunResults& results, const Scenario& scenario, const PageParts& parts);

// Writes metrics.json, draws the figures, and writes report.html last.
void write_report(const ReportRequest& request);

// The same from DIR/metrics.json, DIR/data and DIR/model of a finished run. `scenario` is that of the run; its targets
// are drawn if their files are found, else a warning gives the reason. Throws InputError for a directory that is no
// finished run.
void write_report(const std::filesystem::path& directory, const Scenario& scenario, int threads,
                  const StopFlag* stop = nullptr);

}  // namespace seaglint

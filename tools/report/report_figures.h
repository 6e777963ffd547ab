// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The figures of a report, as files in its directory: accuracy over wave height, receiver operating characteristics,
// maps, features, aspects, sea, targets.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tools/figure/figure.h"
#include "tools/pipeline/scene.h"
#include "tools/report/metrics.h"
#include "tools/report/report_data.h"

namespace seaglint {

// Detections over false alarms, %: of two classes a curve of each group of features, of more a curve of each class
// against the rest by the fused features.
LinePlot roc_plot(const Study& study, const SplitSpec& split, Protocol protocol);

// A figure of the report; both files show the same picture; `svg` is empty for mesh pictures and maps.
struct ReportFigure {
  std::string section;  // maps, accuracy, scatter, features, aspects, sea, targets
  std::filesystem::path png;
  std::filesystem::path svg;
  std::string caption;      // HTML
  std::string alternative;  // plain text
  std::string plot;         // plot_json(); empty: the picture alone
};

// A report to be written.
struct ReportRequest {
  const std::filesystem::path& directory;
  const Scenario& scenario;
  const SamplePlan& plan;
  const std::vector<Target>& targets;  // of the scenario; if empty, neither targets nor motion are drawn
  RunResults& results;                 // gets the seconds of the stage `report`
  int threads = 0;                     // 0 = all processors
  const StopFlag* stop = nullptr;
};

// Draws all figures into the run's directory; the list has the order of the page.
std::vector<ReportFigure> draw_report_figures(const ReportRequest& request);

}  // namespace seaglint

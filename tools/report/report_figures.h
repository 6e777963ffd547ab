// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The figures of a report, as files in its directory: accuracy over wave height, receiver operating characteristics,
// maps, features, aspects, sea, targets.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"
#include "tools/figure/figure.h"
#include "tools/pipeline/scene.h"
#include "tools/report/report_data.h"

namespace seaglint {

// Accuracy over wave height and receiver operating characteristics, from metrics.json.

// Accuracy of the three groups of features under a protocol (random, group), %, with 95 % intervals.
LinePlot accuracy_plot(const nlohmann::ordered_json& metrics, const std::string& protocol);

// The same under the group protocol over the drawn keys of numbers, by key: over the means of their bins.
std::vector<std::pair<std::string, LinePlot>> drawn_accuracy_plots(const nlohmann::ordered_json& metrics);

// Detections over false alarms of the fused features under the group protocol, %, a curve for each bin of the wave
// height; none of more than two classes, and with one bin.
std::optional<LinePlot> roc_by_wave_height_plot(const nlohmann::ordered_json& metrics);

// Detections over false alarms, %.
LinePlot roc_plot(const nlohmann::ordered_json& metrics, const std::string& protocol);

// A figure of the report; both files show the same picture; `svg` is empty for mesh pictures and maps.
struct ReportFigure {
  std::string section;  // maps, accuracy, scatter, features, aspects, sea, targets
  std::filesystem::path png;
  std::filesystem::path svg;
  std::string caption;      // HTML
  std::string alternative;  // plain text
  std::string plot;         // plot_json(); empty: the picture alone
};

// Draws all figures into the run's directory, on `threads` threads; the list has the order of the page. `targets` are
// those of the scenario; if empty, neither targets nor motion are drawn.
std::vector<ReportFigure> draw_report_figures(const std::filesystem::path& directory, const Scenario& scenario,
                                              const SamplePlan& plan, const std::vector<Target>& targets,
                                              const ReportData& data, const nlohmann::ordered_json& metrics,
                                              int threads, const StopFlag* stop);

}  // namespace seaglint

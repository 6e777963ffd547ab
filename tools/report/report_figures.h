// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The figures of a report, as files in its directory.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"
#include "tools/pipeline/scene.h"
#include "tools/report/report_data.h"

namespace seaglint {

// A figure of the report; both files show the same picture; `svg` is empty for mesh pictures and maps.
struct ReportFigure {
  std::string section;  // maps, accuracy, scatter, features, aspects, sea, targets
  std::filesystem::path png;
  std::filesystem::path svg;
  std::string caption;      // HTML
  std::string alternative;  // plain text
  std::string plot;         // plot_json.h; empty: the picture alone
};

// Draws all figures into the run's directory, on `threads` threads; the list has the order of the page. `targets` are
// those of the scenario; if empty, neither targets nor motion are drawn.
std::vector<ReportFigure> draw_report_figures(const std::filesystem::path& directory, const Scenario& scenario,
                                              const SamplePlan& plan, const std::vector<Target>& targets,
                                              const ReportData& data, const nlohmann::ordered_json& metrics,
                                              int threads, const StopFlag* stop);

}  // namespace seaglint

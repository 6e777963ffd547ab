// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "classify/dataset/directory/merged.h"
#include "radar/waveform/figures_of_merit.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/printable.h"
#include "sim/core/process/standard_error.h"
#include "sim/motion/target_motion.h"
#include "sim/scenario/files/scatter_diagram.h"
#include "sim/sea/realisation.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

namespace {

// The sea state with the widest strata, the only one that is reported.
struct CoarsestSea {
  double width = 0;  // relative to the peak frequency
  double peak_period_s = 0;
};

void add_doubt(std::vector<std::string>& lines, const char* key, int components, const CoarsestSea& sea) {
  if (sea.width <= kMaxStratumWidth) return;
  lines.push_back(fmt::format(
      "{}: {} components at Tp {:.3g} s give strata {:.2g} of the peak frequency wide, so that the mean period varies "
      "between realisations; {:.0f} or more keep it within about 1 %",
      key, components, sea.peak_period_s, sea.width, std::ceil(components * sea.width / kMaxStratumWidth)));
}

// Those of a target's smallest and largest body.
void add_mesh_warnings(std::vector<std::string>& lines, const Target& target) {
  if (target.models.empty()) return;
  const auto [smallest, largest] =
      std::ranges::minmax(target.models, {}, [](const auto& model) { return model->scale; });
  const std::vector<std::string>& of_smallest = smallest->prepared->warnings;
  for (const std::string& warning : of_smallest)
    lines.push_back(fmt::format("targets.{}.mesh: {}", target.spec.name, warning));
  for (const std::string& warning : largest->prepared->warnings) {
    if (std::ranges::find(of_smallest, warning) == of_smallest.end())
      lines.push_back(
          fmt::format("targets.{}.mesh, {:.6g} times as large: {}", target.spec.name, largest->scale, warning));
  }
}

// What of the target's bodies is below the water: that of the deepest one.
void add_waterline_warning(std::vector<std::string>& lines, const Target& target) {
  std::size_t cut = 0;
  SubmergedPart deepest;
  for (const auto& model : target.models) {
    const SubmergedPart& below = model->prepared->below;
    if (below.depth_m > 0) ++cut;
    if (below.depth_m > deepest.depth_m) deepest = below;
  }
  if (cut == 0) return;
  const std::string which =
      target.models.size() == 1 ? "" : fmt::format("of {} of {} bodies, ", cut, target.models.size());
  lines.push_back(fmt::format("targets.{}.mesh: {}{}{}; offset_m moves it", target.spec.name, which,
                              cut > 1 ? "at most " : "", cut_sentence(deepest)));
}

}  // namespace

std::vector<std::string> mesh_warnings(const Pipeline& pipeline) {
  std::vector<std::string> lines;
  // no companions
  for (const Target& target : std::span(pipeline.targets()).first(pipeline.scenario().targets.size())) {
    add_mesh_warnings(lines, target);
    add_waterline_warning(lines, target);
    std::string hovering;  // of the first such body
    for (const auto& model : target.models) {
      const std::string line = hovering_warning(target.spec, bounds(model->prepared->mesh));
      if (hovering.empty()) hovering = line;
    }
    if (!hovering.empty()) lines.push_back(hovering);
  }
  return lines;
}

std::vector<std::string> motion_warnings(const Pipeline& pipeline) {
  std::vector<std::string> lines;
  for (const Target& target : std::span(pipeline.targets()).first(pipeline.scenario().targets.size())) {
    const auto* series =
        target.models.empty() ? nullptr : std::get_if<AttitudeSeries>(&target.models.front()->motion->model);
    if (!target.models.empty()) {
      const std::string finding = hull_warning(target.spec, *target.models.front()->motion);
      if (!finding.empty()) lines.push_back(finding);
    }
    if (series == nullptr || series->grid != TimeGrid::kIrregular) continue;
    lines.push_back(fmt::format("targets.{}.motion.file: the times of {} are not uniform: resampled by a spline",
                                target.spec.name, series->source));
  }
  return lines;
}

std::string motion_file_note(const TargetSpec& target, const Body& body) {
  const std::string reading = motion_file_reading(body);
  return reading.empty() ? reading : fmt::format("targets.{}.motion.file: {}", target.name, reading);
}

std::string hull_warning(const TargetSpec& target, const Body& body) {
  if (target.motion.model != MotionModel::kShip && target.motion.model != MotionModel::kRao) return "";
  const std::string finding = orientation_finding(body.shape);
  return finding.empty() ? finding : fmt::format("targets.{}.mesh: {}", target.name, finding);
}

std::string hovering_warning(const TargetSpec& target, const Bounds& box) {
  const bool is_ship = target.motion.model == MotionModel::kShip || target.motion.model == MotionModel::kRao;
  if (!is_ship && target.motion.model != MotionModel::kFloat) return "";
  if (is_raft(target.layout) || (target.layout && target.layout->heights_m)) return "";
  constexpr double kRounding = 1e-3;  // of its size: a mesh that ends at the waterline
  const double rounding = kRounding * (box.upper - box.lower).maxCoeff();
  const double gap = box.lower.z() + rest_height_m(target);
  const bool is_drawn_to_waterline = is_ship || box.lower.z() > -rounding;
  if (gap <= (is_drawn_to_waterline ? rounding : box.upper.z() - box.lower.z())) return "";
  return fmt::format(
      "targets.{}.mesh: its lowest point is {:.3g} m above the water, where nothing carries it: is its waterline at z "
      "= "
      "{:.6g} m? {}",
      target.name, gap, 0.0 - rest_height_m(target),
      is_ship ? "offset_m lowers it" : "motion.origin_above_waterline_m or offset_m lowers it");
}

void report_motion(const TargetSpec& target, const Body& body) {
  const std::string note = motion_file_note(target, body);
  if (!note.empty()) print_error(on_one_line(note) + "\n");
  for (const std::string& finding : {hull_warning(target, body), hovering_warning(target, body.shape.box)})
    if (!finding.empty()) warn(std::vector{finding});
}

void report_spectrum_table(const Scenario& scenario) {
  if (scenario.sea.table_values == nullptr) return;
  const SpectrumTable& table = *scenario.sea.table_values;
  print_error(
      on_one_line(fmt::format("sea.table: {}: {}; {} frequencies, {:.4g} to {:.4g} rad/s, Hs {:.4g} m, Tp {:.4g} s",
                              scenario.sea.table, table.reading, table.omega.size(), table.omega.front(),
                              table.omega.back(), 4 * std::sqrt(table.energy()), 2 * kPi / table.peak_omega())) +
      "\n");
}

void report_motion_files(const Pipeline& pipeline) {
  for (const Target& target : std::span(pipeline.targets()).first(pipeline.scenario().targets.size())) {
    if (target.models.empty()) continue;
    const std::string note = motion_file_note(target.spec, *target.models.front()->motion);
    if (!note.empty()) print_error(on_one_line(note) + "\n");
  }
}

std::vector<std::string> sea_warnings(const Scenario& scenario, std::span<const SeaState> states) {
  CoarsestSea wind_sea, swell;
  for (const SeaState& state : states) {
    const StratumWidths widths = stratum_widths(state);
    if (widths.wind_sea > wind_sea.width) wind_sea = {widths.wind_sea, state.peak_period_s};
    if (widths.swell > swell.width) swell = {widths.swell, state.swell.peak_period_s};
  }
  std::vector<std::string> lines;
  add_doubt(lines, "sea.components", scenario.sea.components, wind_sea);
  add_doubt(lines, "sea.swell.components", scenario.sea.swell.components, swell);
  for (const Variation& variation : scenario.variations) {
    const ScatterDiagram* diagram = variation.distribution.diagram.get();
    if (diagram == nullptr || variation.distribution.is_period || diagram->excluded_cells == 0) continue;
    lines.push_back(fmt::format(
        "{}: the seas of {} of {} cells, {:.2g} % of the counts, may break (Hs above L/7): not drawn", kScatterKey,
        diagram->excluded_cells, diagram->excluded_cells + diagram->cells.size(), 100 * diagram->excluded_fraction));
  }
  return lines;
}

std::vector<std::string> band_warnings(const Pipeline& pipeline) {
  const Scenario& scenario = pipeline.scenario();
  const std::string gaps = band_gap_warning(make_pulse_train(scenario.radar, pipeline.window_m(), scenario.seed, 0));
  if (gaps.empty()) return {};
  return {fmt::format("radar.bandwidth_mhz: {}", gaps)};
}

std::vector<std::string> data_set_warnings(const DatasetReader& reader) {
  std::vector<std::string> lines;
  if (const auto sentence = merged_file_of_another_manifest(reader)) lines.push_back(*sentence);
  return lines;
}

void warn(std::span<const std::string> sentences) {
  for (const std::string& sentence : sentences)
    print_error(fmt::format("seaglint: warning: {}\n", on_one_line(sentence)));
}

}  // namespace seaglint

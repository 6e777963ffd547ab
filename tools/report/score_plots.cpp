// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/score_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "classify/model/data_rows.h"
#include "tools/pipeline/metrics.h"

namespace seaglint {
namespace {

constexpr std::size_t kMostDrawnPlots = 12;  // of one report; metrics.json has the others, too

constexpr std::pair<const char*, const char*> kGroups[3] = {
    {"handmade", "hand-made"}, {"cnn", "CNN"}, {"fused", "fused"}};

std::string split_name(const nlohmann::ordered_json& metrics, const std::string& protocol) {
  if (protocol == "random") return "random split of the maps";
  const DivisionWords division = division_words(metrics);
  return division.by_sea ? "split by sea realisation" : "split " + division.by;
}

void add_curve(Series& series, const nlohmann::ordered_json& curve) {
  for (const double x : curve.at("false_alarms")) series.x.push_back(100 * x);
  for (const double y : curve.at("detections")) series.y.push_back(100 * y);
}

// Of two classes, without curves.
LinePlot empty_roc_plot(std::string title) {
  LinePlot plot;
  plot.title = std::move(title);
  plot.x = {"false alarms: label 0 declared label 1 (%)", AxisRange{0, 100}, false};
  plot.y = {"detections: label 1 declared label 1 (%)", AxisRange{0, 102}, false};
  return plot;
}

Series chance() { return {"chance", {0, 100}, {0, 100}, {}, SeriesStyle::kLines}; }

// Of more than two classes: each against the rest, by the fused features.
LinePlot rest_roc_plot(const nlohmann::ordered_json& curves, const std::string& split) {
  LinePlot plot;
  plot.title = "ROC of each class against the rest, fused, " + split;
  plot.x = {"false alarms: others declared the class (%)", AxisRange{0, 100}, false};
  plot.y = {"detections of the class (%)", AxisRange{0, 102}, false};
  for (const auto& [name, curve] : curves.items()) {
    Series series;
    series.name = name;
    add_curve(series, curve);
    plot.series.push_back(std::move(series));
  }
  plot.series.push_back(chance());
  return plot;
}

// Accuracy of each group of features over the values `x` of the bins of bins_of(group).
template <class BinsOf>
LinePlot binned_accuracy_plot(std::string title, FigureAxis axis, const char* x, BinsOf bins_of) {
  LinePlot plot;
  plot.title = std::move(title);
  plot.x = std::move(axis);
  double least = std::numeric_limits<double>::infinity(), most = -least, lowest = 50;
  for (const auto& row : bins_of(kGroups[0].first)) {
    least = std::min(least, value_or_nan(row.at(x)));
    most = std::max(most, value_or_nan(row.at(x)));
  }
  const double span = most > least ? most - least : std::max(most, 0.0);
  double shift = -0.012 * span;  // offset, so that the error bars do not overlap
  for (const auto& [group, label] : kGroups) {
    Series series;
    series.name = label;
    series.style = SeriesStyle::kLinesPoints;
    for (const auto& row : bins_of(group)) {
      const double accuracy = 100 * value_or_nan(row.at("accuracy"));
      const double low = 100 * value_or_nan(row.at("accuracy_95").at(0)),
                   high = 100 * value_or_nan(row.at("accuracy_95").at(1));
      series.x.push_back(value_or_nan(row.at(x)) + shift);
      series.y.push_back(accuracy);
      series.interval.push_back({std::isfinite(low) ? low : accuracy, std::isfinite(high) ? high : accuracy});
      lowest = std::min(lowest, series.interval.back()[0]);
    }
    plot.series.push_back(std::move(series));
    shift += 0.012 * span;
  }
  plot.y = {"accuracy on test maps (%)", AxisRange{std::floor(lowest / 10) * 10, 102}, false};
  return plot;
}

}  // namespace

LinePlot accuracy_plot(const nlohmann::ordered_json& metrics, const std::string& protocol) {
  return binned_accuracy_plot(
      "Accuracy, " + split_name(metrics, protocol), {"significant wave height (m)", {}, false},
      kWaveHeightColumn, [&](const char* group) -> const auto& {
        return metrics.at(group).at(protocol).at("by_wave_height");
      });
}

std::vector<std::pair<std::string, LinePlot>> drawn_accuracy_plots(const nlohmann::ordered_json& metrics) {
  std::vector<std::pair<std::string, LinePlot>> plots;
  const auto& handmade = metrics.at("handmade").at("group");
  if (!handmade.contains("by_drawn")) return plots;
  for (std::size_t i = 0; i < handmade.at("by_drawn").size() && plots.size() < kMostDrawnPlots; ++i) {
    const auto& condition = handmade.at("by_drawn").at(i);
    const std::string key = condition.at("column"), units = condition.at("units");
    const auto& bins = condition.at("bins");
    if (bins.size() < 2 || !bins.front().at("mean").is_number()) continue;  // words and single values have no axis
    plots.emplace_back(key, binned_accuracy_plot(
                                "Accuracy, " + split_name(metrics, "group"),
                                {units == "1" ? key : fmt::format("{} ({})", key, units), {}, false},
                                "mean", [&](const char* group) -> const auto& {
                                  return metrics.at(group).at("group").at("by_drawn").at(i).at("bins");
                                }));
  }
  return plots;
}

std::optional<LinePlot> roc_by_wave_height_plot(const nlohmann::ordered_json& metrics) {
  LinePlot plot = empty_roc_plot("ROC by wave height, fused, " + split_name(metrics, "group"));
  for (const auto& row : metrics.at("fused").at("group").at("by_wave_height")) {
    const auto& roc = row.at("roc");
    if (!roc.contains("detections")) return std::nullopt;  // more than two classes
    if (roc.at("detections").empty()) continue;            // maps of one class only
    Series series;
    series.name = fmt::format("{} m, AUC {:.3f}", row.at("bin").get<std::string>(), value_or_nan(row.at("auc")));
    add_curve(series, roc);
    plot.series.push_back(std::move(series));
  }
  if (plot.series.size() < 2) return std::nullopt;
  plot.series.push_back(chance());
  return plot;
}

LinePlot roc_plot(const nlohmann::ordered_json& metrics, const std::string& protocol) {
  const auto& fused = metrics.at("fused").at(protocol).at("roc");
  if (!fused.contains("detections")) return rest_roc_plot(fused, split_name(metrics, protocol));
  LinePlot plot = empty_roc_plot("ROC, " + split_name(metrics, protocol));
  for (const auto& [group, label] : kGroups) {
    const auto& scores = metrics.at(group).at(protocol);
    Series series;
    series.name = fmt::format("{}, AUC {:.3f}", label, value_or_nan(scores.at("auc")));
    add_curve(series, scores.at("roc"));
    plot.series.push_back(std::move(series));
  }
  plot.series.push_back(chance());
  return plot;
}

}  // namespace seaglint

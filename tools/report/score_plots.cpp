// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/score_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "tools/pipeline/metrics.h"

namespace seaglint {
namespace {

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

}  // namespace

LinePlot accuracy_plot(const nlohmann::ordered_json& metrics, const std::string& protocol) {
  LinePlot plot;
  plot.title = "Accuracy, " + split_name(metrics, protocol);
  plot.x.label = "significant wave height (m)";
  double span = 0, lowest = 50;
  for (const auto& row : metrics.at("handmade").at(protocol).at("by_wave_height"))
    span = std::max(span, row.at("significant_wave_height_m").get<double>());
  double shift = -0.012 * span;  // offset, so that the error bars do not overlap
  for (const auto& [group, label] : kGroups) {
    Series series;
    series.name = label;
    series.style = SeriesStyle::kLinesPoints;
    for (const auto& row : metrics.at(group).at(protocol).at("by_wave_height")) {
      const double accuracy = 100 * value_or_nan(row.at("accuracy"));
      const double low = 100 * value_or_nan(row.at("accuracy_95").at(0)),
                   high = 100 * value_or_nan(row.at("accuracy_95").at(1));
      series.x.push_back(row.at("significant_wave_height_m").get<double>() + shift);
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

std::optional<LinePlot> roc_plot(const nlohmann::ordered_json& metrics, const std::string& protocol) {
  const auto& fused = metrics.at("fused").at(protocol);
  if (fused.contains("roc") && !fused.at("roc").contains("detections"))
    return rest_roc_plot(fused.at("roc"), split_name(metrics, protocol));
  LinePlot plot;
  plot.title = "ROC, " + split_name(metrics, protocol);
  plot.x = {"false alarms: label 0 declared label 1 (%)", AxisRange{0, 100}, false};
  plot.y = {"detections: label 1 declared label 1 (%)", AxisRange{0, 102}, false};
  for (const auto& [group, label] : kGroups) {
    const auto& scores = metrics.at(group).at(protocol);
    if (!scores.contains("roc")) return std::nullopt;
    Series series;
    series.name = fmt::format("{}, AUC {:.3f}", label, value_or_nan(scores.at("auc")));
    add_curve(series, scores.at("roc"));
    plot.series.push_back(std::move(series));
  }
  plot.series.push_back(chance());
  return plot;
}

}  // namespace seaglint

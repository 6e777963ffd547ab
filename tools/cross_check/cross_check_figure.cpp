// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cross_check/cross_check_figure.h"

#include <algorithm>
#include <array>
#include <utility>

namespace seaglint {
namespace {

constexpr std::array kElement{"hh", "vv"};

FigureAxis axis_of(std::string label, const std::vector<double>& values, double margin, double longest) {
  const auto [low, high] = std::ranges::minmax(values);
  return {std::move(label), AxisRange{std::max(low, high - longest) - margin, high + margin}, false};
}

}  // namespace

PlotPanels cross_check_plots(const CrossCheck& check) {
  const auto varies = [&](double CrossCheckRow::*angle) {
    return std::ranges::any_of(check.rows,
                               [&](const CrossCheckRow& row) { return row.*angle != check.rows.front().*angle; });
  };
  const bool azimuth = varies(&CrossCheckRow::azimuth_deg), elevation = varies(&CrossCheckRow::elevation_deg);
  if (azimuth == elevation) return {};
  constexpr double kMargin_db = 3, kLongest_db = 60;
  PlotPanels panels{{}, 2, {1500, 800}};
  for (const bool levels : {true, false}) {
    for (std::size_t element = 0; element < kElement.size(); ++element) {
      Series beams{"beams", {}, {}, {}, SeriesStyle::kLines}, rays{"rays", {}, {}, {}, SeriesStyle::kLines},
          difference{"", {}, {}, {}, SeriesStyle::kLines};
      std::vector<double> both;
      for (const CrossCheckRow& row : check.rows) {
        if (row.element != element) continue;
        beams.x.push_back(azimuth ? row.azimuth_deg : row.elevation_deg);
        beams.y.push_back(row.beams_dbsm);
        rays.y.push_back(row.rays_dbsm);
        difference.y.push_back(row.relative_db);
        both.insert(both.end(), {row.beams_dbsm, row.rays_dbsm});
      }
      rays.x = difference.x = beams.x;
      LinePlot plot;
      plot.x = axis_of(azimuth ? "azimuth (deg)" : "elevation (deg)", beams.x, 0, 1e9);
      if (levels) {
        plot.title = kElement[element];
        plot.y = axis_of("radar cross section (dBsm)", both, kMargin_db, kLongest_db);
        plot.legend_above = true;
        plot.series = {std::move(beams), std::move(rays)};
      } else {
        plot.y = axis_of("relative difference (dB)", difference.y, kMargin_db, kLongest_db);
        plot.series = {std::move(difference)};
      }
      panels.plots.push_back(std::move(plot));
    }
  }
  return panels;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_figure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <utility>

#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

namespace {

// The values along one axis of a sweep, at one place of the other two.
struct LevelCurve {
  std::string title;
  std::vector<double> x;
  std::array<std::vector<double>, 2> dbsm;  // hh, vv
};

double level_at(const RcsSweep& sweep, std::size_t azimuth, std::size_t elevation, std::size_t frequency,
                std::size_t element) {
  const auto& matrices = sweep.models.back().matrices;
  return dbsm(matrices[elevation * sweep.azimuth_deg.size() + azimuth][frequency][kCoPolar[element]], kMinPrinted_m2);
}

constexpr double kMostLevelSpan = 70;  // dB, of the axis of levels

enum class DrawnAxis { kAzimuth, kFrequency, kElevation };

LevelCurve curve_along(const RcsSweep& sweep, DrawnAxis axis, std::size_t first, std::size_t second) {
  LevelCurve curve;
  const auto add = [&](double x, std::size_t azimuth, std::size_t elevation, std::size_t frequency) {
    curve.x.push_back(x);
    for (std::size_t element = 0; element < 2; ++element)
      curve.dbsm[element].push_back(level_at(sweep, azimuth, elevation, frequency, element));
  };
  const auto ghz = [&](std::size_t i) { return 1e-9 * sweep.frequency_hz[i]; };
  switch (axis) {
    case DrawnAxis::kAzimuth:
      curve.title = fmt::format("{:g} GHz, elevation {:g} deg", ghz(second), sweep.elevation_deg[first]);
      for (std::size_t i = 0; i < sweep.azimuth_deg.size(); ++i) add(sweep.azimuth_deg[i], i, first, second);
      break;
    case DrawnAxis::kFrequency:
      curve.title =
          fmt::format("azimuth {:g} deg, elevation {:g} deg", sweep.azimuth_deg[second], sweep.elevation_deg[first]);
      for (std::size_t i = 0; i < sweep.frequency_hz.size(); ++i) add(ghz(i), second, first, i);
      break;
    case DrawnAxis::kElevation:
      curve.title = fmt::format("{:g} GHz, azimuth {:g} deg", ghz(second), sweep.azimuth_deg[first]);
      for (std::size_t i = 0; i < sweep.elevation_deg.size(); ++i) add(sweep.elevation_deg[i], first, i, second);
      break;
  }
  return curve;
}

// At most `most` of the indices 0 ... count - 1, evenly chosen, the first and last among them.
std::vector<std::size_t> evenly(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t kept = std::min(count, most);
  for (std::size_t i = 0; i < kept; ++i) chosen.push_back(kept == 1 ? 0 : i * (count - 1) / (kept - 1));
  return chosen;
}

double percentile(std::vector<double> values, double p) {
  std::ranges::sort(values);
  return quantile(values, p);
}

// The median of the values within half a window on either side of each. x ascending; a full turn of azimuths, degrees,
// goes on at its other end.
std::vector<double> moving_median(const std::vector<double>& x, const std::vector<double>& values, double window) {
  constexpr double kTurn = 360;
  const double span = x.back() - x.front(), step = span / static_cast<double>(x.size() - 1);
  std::vector<std::pair<double, double>> around;  // x, value; ascending
  for (const double shift : {-kTurn, 0.0, kTurn}) {
    if (shift != 0 && span < kTurn - 1.5 * step) continue;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double place = x[i] + shift;
      if (shift == 0 || (shift < 0 ? place < x.front() - step / 2 : place > x.back() + step / 2))
        around.emplace_back(place, values[i]);
    }
  }
  std::vector<double> medians;
  std::size_t first = 0, last = 0;
  for (const double place : x) {
    while (around[first].first < place - window / 2) ++first;
    while (last < around.size() && around[last].first <= place + window / 2) ++last;
    std::vector<double> within;
    for (std::size_t i = first; i < last; ++i) within.push_back(around[i].second);
    medians.push_back(percentile(std::move(within), 0.5));
  }
  return medians;
}

// Between the numbers of an axis of azimuths, degrees; 0: as other axes.
double azimuth_step(double span) { return span >= 270 ? 45 : span >= 120 ? 30 : span >= 60 ? 15 : 0; }

LinePlot plot_of_levels(const LevelCurve& curve, DrawnAxis axis, bool polar) {
  constexpr std::array kLabels{"azimuth (deg)", "frequency (GHz)", "elevation (deg)"};
  LinePlot plot;
  plot.title = curve.title;
  plot.x = {kLabels[static_cast<std::size_t>(axis)], {}, false};
  if (axis == DrawnAxis::kAzimuth) plot.x.step = azimuth_step(curve.x.back() - curve.x.front());
  double highest = -kMostLevelSpan, lowest = 0;
  for (const auto& levels : curve.dbsm) highest = std::max(highest, *std::ranges::max_element(levels));
  lowest = highest;
  for (const auto& levels : curve.dbsm) lowest = std::min(lowest, percentile(levels, 0.02));
  lowest = std::max(lowest, highest - kMostLevelSpan);
  plot.y = {"radar cross section (dBsm)", AxisRange{5 * std::floor(lowest / 5), 5 * std::ceil(highest / 5 + 0.2)},
            false};
  plot.polar = polar;
  if (polar) plot.title += ": radar cross section (dBsm)";
  const bool has_medians = axis == DrawnAxis::kAzimuth && std::ranges::is_sorted(curve.x) &&
                           curve.x.back() - curve.x.front() >= 4 * kMedianWindow_deg;
  constexpr std::array kPale{"#9ecae1", "#fdc086"}, kStrong{"#0072b2", "#d55e00"};
  const auto add = [&](std::string name, std::vector<double> levels, const char* colour, double width) {
    Series series{std::move(name), curve.x, std::move(levels), {}, SeriesStyle::kLines};
    series.colour = colour;
    series.width = width;
    plot.series.push_back(std::move(series));
  };
  for (std::size_t element = 0; element < 2; ++element)
    add(kCoPolarNames[element], curve.dbsm[element], has_medians ? kPale[element] : kStrong[element], 1.2);
  for (std::size_t element = 0; has_medians && element < 2; ++element)
    add(fmt::format("{}, median in {:g} deg", kCoPolarNames[element], kMedianWindow_deg),
        moving_median(curve.x, curve.dbsm[element], kMedianWindow_deg), kStrong[element], 2.4);
  return plot;
}

}  // namespace

std::vector<LevelStatistics> level_statistics(const RcsSweep& sweep) {
  std::vector<LevelStatistics> all;
  if (sweep.azimuth_deg.size() < kFewestDrawn) return all;
  for (std::size_t f = 0; f < sweep.frequency_hz.size(); ++f) {
    for (std::size_t e = 0; e < sweep.elevation_deg.size(); ++e) {
      const LevelCurve curve = curve_along(sweep, DrawnAxis::kAzimuth, e, f);
      for (std::size_t element = 0; element < 2; ++element) {
        const std::vector<double>& levels = curve.dbsm[element];
        const auto largest = static_cast<std::size_t>(std::ranges::max_element(levels) - levels.begin());
        double area = 0;
        for (const double level : levels) area += std::pow(10, level / 10) / static_cast<double>(levels.size());
        all.push_back({element, sweep.frequency_hz[f], sweep.elevation_deg[e], percentile(levels, 0.1),
                       percentile(levels, 0.5), percentile(levels, 0.9), dbsm_of_area(area, kMinPrinted_m2),
                       levels[largest], curve.x[largest]});
      }
    }
  }
  return all;
}

std::string statistics_text(const std::vector<LevelStatistics>& statistics) {
  constexpr std::size_t kMost = 8;
  if (statistics.empty()) return "";
  std::string text = "dBsm over azimuth           10 %    50 %    90 %    mean   largest  at azimuth\n";
  for (std::size_t i = 0; i < std::min(kMost, statistics.size()); ++i) {
    const LevelStatistics& s = statistics[i];
    text += fmt::format("{}, {:>7.6g} GHz, {:>5.4g} deg  {:8.1f}{:8.1f}{:8.1f}{:8.1f}{:10.1f}  {:8.6g} deg\n",
                        kCoPolarNames[s.element], 1e-9 * s.frequency_hz, s.elevation_deg, s.lowest_tenth_dbsm,
                        s.median_dbsm, s.highest_tenth_dbsm, s.mean_dbsm, s.largest_dbsm, s.largest_azimuth_deg);
  }
  if (statistics.size() > kMost)
    text += fmt::format("and {} more frequencies and elevations\n", statistics.size() / 2 - kMost / 2);
  return text;
}

std::vector<std::string> solver_notes(const RcsRequest& request) {
  std::vector<std::string> notes;
  if (!request.selection.only.empty() || !request.selection.without.empty())
    notes.push_back("contributions: " + text_of(request.selection));
  if (request.sea.reflection)
    notes.push_back(
        fmt::format("above the sea, origin at {:g} m, Hs {:g} m", request.sea.height_m, request.sea.wave_height_m));
  if (request.range_m > 0) notes.push_back(fmt::format("wavefront of {:g} m", request.range_m));
  if (!request.cavities.parts.empty())
    notes.push_back(
        fmt::format("cavities {} by the magnetic-field integral equation", fmt::join(request.cavities.parts, ", ")));
  notes.push_back(fmt::format("{}, edges {}, {} bounces{}", kSolverMethodNames[static_cast<int>(request.method)],
                              request.edges ? "on" : "off", request.max_bounces,
                              !request.crease_deg        ? ""
                              : *request.crease_deg == 0 ? ", flat facets"
                                                         : fmt::format(", crease {:g} deg", *request.crease_deg)));
  notes.push_back(fmt::format("seaglint {}", kVersion));
  return notes;
}

std::vector<std::string> sweep_notes(const RcsRequest& request) {
  const auto axis = [](const char* name, const std::vector<double>& values, double unit, const char* unit_name) {
    if (values.size() == 1) return fmt::format("{}{:.9g} {}", name, unit * values[0], unit_name);
    return fmt::format("{}{:.9g} to {:.9g} {} in steps of {:.4g}", name, unit * values.front(), unit * values.back(),
                       unit_name, unit * (values[1] - values[0]));
  };
  std::vector<std::string> notes{axis("", request.frequency_hz, 1e-9, "GHz"),
                                 axis("azimuth ", request.azimuth_deg, 1, "deg"),
                                 axis("elevation ", request.elevation_deg, 1, "deg")};
  if (request.average > 1)
    notes.push_back(fmt::format("every level the mean of {} azimuths over the step", request.average));
  if (request.transmitter)
    notes.push_back(fmt::format("transmitter at azimuth {:g} deg, elevation {:g} deg", request.transmitter->azimuth_deg,
                                request.transmitter->elevation_deg));
  const std::vector<std::string> solver = solver_notes(request);
  notes.insert(notes.end(), solver.begin(), solver.end());
  return notes;
}

PlotPanels level_plots(const RcsSweep& sweep, bool polar) {
  constexpr std::size_t kMostPanels = 4;
  const std::size_t azimuths = sweep.azimuth_deg.size(), frequencies = sweep.frequency_hz.size(),
                    elevations = sweep.elevation_deg.size();
  DrawnAxis axis = DrawnAxis::kAzimuth;
  if (polar && azimuths < kFewestDrawn) return {};
  if (azimuths < kFewestDrawn) axis = frequencies >= kFewestDrawn ? DrawnAxis::kFrequency : DrawnAxis::kElevation;
  if (axis == DrawnAxis::kElevation && elevations < kFewestDrawn) return {};
  const std::size_t firsts = axis == DrawnAxis::kElevation ? azimuths : elevations;
  const std::size_t seconds = axis == DrawnAxis::kFrequency ? azimuths : frequencies;
  PlotPanels panels;
  for (const std::size_t place : evenly(firsts * seconds, kMostPanels))
    panels.plots.push_back(plot_of_levels(curve_along(sweep, axis, place / seconds, place % seconds), axis, polar));
  const bool is_one = panels.plots.size() == 1;
  panels.columns = is_one ? 1 : 2;
  const int rows = panels.plots.size() > 2 ? 2 : 1;
  panels.size = polar ? FigureSize{is_one ? 820 : 1500, (is_one ? 900 : 820) * rows}
                      : FigureSize{is_one ? 1100 : 1500, rows == 2 ? 1000 : 520};
  return panels;
}

}  // namespace seaglint

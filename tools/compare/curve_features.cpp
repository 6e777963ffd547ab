// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/curve_features.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "tools/figure/figure.h"

namespace seaglint {

namespace {

constexpr double kLeast_db = 3;  // between a lobe and the nulls beside it

// The vertex of the parabola through three points; the middle one where they are on a line.
Extremum vertex(std::span<const double> x, std::span<const double> y, std::size_t i) {
  const double a = x[i - 1] - x[i], b = x[i + 1] - x[i], u = y[i - 1] - y[i], v = y[i + 1] - y[i];
  const double square = (u / a - v / b) / (a - b), slope = u / a - square * a;
  if (square == 0) return {x[i], y[i]};
  const double at = std::clamp(-slope / (2 * square), a, b);
  return {x[i] + at, y[i] + at * (slope + square * at)};
}

// Indices of alternating maxima and minima that differ by at least kLeast_db.
std::vector<std::size_t> turning_points(std::span<const double> y) {
  std::vector<std::size_t> points;
  if (y.size() < 3) return points;
  std::size_t highest = 0, lowest = 0;
  int direction = 0;  // of the last confirmed change
  for (std::size_t i = 1; i < y.size(); ++i) {
    if (y[i] > y[highest]) highest = i;
    if (y[i] < y[lowest]) lowest = i;
    if (direction >= 0 && y[highest] - y[i] >= kLeast_db) {
      points.push_back(highest);
      direction = -1;
      lowest = highest = i;
    } else if (direction <= 0 && y[i] - y[lowest] >= kLeast_db) {
      points.push_back(lowest);
      direction = 1;
      lowest = highest = i;
    }
  }
  return points;
}

std::vector<Extremum> extrema(std::span<const double> x, std::span<const double> y, double lowest_db, double sign) {
  std::vector<Extremum> found;
  for (const std::size_t i : turning_points(y)) {
    if (i == 0 || i + 1 == y.size() || y[i] < lowest_db) continue;
    if (sign * (2 * y[i] - y[i - 1] - y[i + 1]) <= 0) continue;
    found.push_back(vertex(x, y, i));
  }
  return found;
}

std::size_t nearest(std::span<const Extremum> extrema, double x) {
  const auto place = std::min_element(extrema.begin(), extrema.end(), [x](const Extremum& a, const Extremum& b) {
    return std::abs(a.x - x) < std::abs(b.x - x);
  });
  return static_cast<std::size_t>(place - extrema.begin());
}

}  // namespace

std::vector<Extremum> lobes_of(std::span<const double> x, std::span<const double> level_db, double lowest_db) {
  return extrema(x, level_db, lowest_db, 1);
}

std::vector<Extremum> nulls_of(std::span<const double> x, std::span<const double> level_db, double lowest_db) {
  return extrema(x, level_db, lowest_db, -1);
}

ExtremumPairs paired_extrema(std::span<const Extremum> reference, std::span<const Extremum> other) {
  ExtremumPairs pairs;
  pairs.count = reference.size();
  for (std::size_t i = 0; i < reference.size() && !other.empty(); ++i) {
    const Extremum& close = other[nearest(other, reference[i].x)];
    if (nearest(reference, close.x) != i) continue;
    ++pairs.paired;
    pairs.mean_shift += std::abs(close.x - reference[i].x);
    pairs.mean_db += std::abs(close.level_db - reference[i].level_db);
  }
  if (pairs.paired == 0) return pairs;
  pairs.mean_shift /= static_cast<double>(pairs.paired);
  pairs.mean_db /= static_cast<double>(pairs.paired);
  return pairs;
}

RangeProfile range_profile(std::span<const PairedCut::Place> places, std::span<const Complex> amplitude_m) {
  constexpr std::size_t kLeast = 8, kMost = 4096, kPerCell = 4;
  const std::size_t n = places.size();
  RangeProfile profile;
  if (n < kLeast || n > kMost || amplitude_m.size() != n) return profile;
  std::vector<double> q;
  for (const PairedCut::Place& place : places) q.push_back(place.path_gradient.norm());
  const double step = (q.back() - q.front()) / static_cast<double>(n - 1);
  if (step <= 0) return profile;
  for (std::size_t i = 0; i < n; ++i) {
    if (std::abs(q[i] - q.front() - static_cast<double>(i) * step) > 0.01 * step) return profile;
  }
  const double whole = 2 * kPi / step, cell = whole / static_cast<double>(kPerCell * n);
  for (std::size_t m = 0; m <= kPerCell * n; ++m) {
    const double range = -0.5 * whole + static_cast<double>(m) * cell;
    profile.range_m.push_back(range);
    profile.level_dbsm.push_back(level_at_range(places, amplitude_m, range));
  }
  return profile;
}

double level_at_range(std::span<const PairedCut::Place> places, std::span<const Complex> amplitude_m, double range_m) {
  const double n = static_cast<double>(places.size());
  Complex sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double window = 1 - std::cos(2 * kPi * (static_cast<double>(i) + 0.5) / n);
    sum += window * amplitude_m[i] * std::polar(1.0, places[i].path_gradient.norm() * range_m);
  }
  return dbsm(sum / n);
}

PlotPanels range_profile_plots(std::span<const PairedCut> cuts) {
  constexpr std::size_t kMostPlots = 4;
  constexpr double kDynamic_db = 60;
  std::vector<LinePlot> plots;
  for (const PairedCut& cut : cuts) {
    if (plots.size() == kMostPlots) break;
    if (cut.axis != CutAxis::kFrequency || cut.amplitude_m.empty() || cut.models[0].amplitude_m.empty()) continue;
    const RangeProfile reference = range_profile(cut.places, cut.amplitude_m),
                       compared = range_profile(cut.places, cut.models[0].amplitude_m);
    if (reference.range_m.empty()) continue;
    const double highest = std::max(*std::max_element(reference.level_dbsm.begin(), reference.level_dbsm.end()),
                                    *std::max_element(compared.level_dbsm.begin(), compared.level_dbsm.end()));
    LinePlot plot;
    plot.legend_above = true;
    plot.title = fmt::format("{}, {}", kPolarisationNames[static_cast<int>(cut.element)], cut.place);
    plot.x = {"range from the phase origin, positive = farther (m)",
              AxisRange{reference.range_m.front(), reference.range_m.back()}, false};
    plot.y = {"range profile (dBsm)", AxisRange{highest - kDynamic_db, highest + 3}, false};
    plot.series = {{cut.reference, reference.range_m, reference.level_dbsm, {}, SeriesStyle::kLines},
                   {cut.models[0].name, compared.range_m, compared.level_dbsm, {}, SeriesStyle::kLines}};
    plots.push_back(std::move(plot));
  }
  if (plots.empty()) return {};
  const int columns = plots.size() == 1 ? 1 : 2, rows = (static_cast<int>(plots.size()) + columns - 1) / columns;
  return {std::move(plots), columns, {columns == 1 ? 900 : 1500, 450 * rows}};
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/range_profiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "tools/figure/figure.h"

namespace seaglint {

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

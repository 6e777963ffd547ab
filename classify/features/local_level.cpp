// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/local_level.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "classify/features/residual_floor.h"

namespace seaglint {
namespace {

// Half widths of the surroundings, in resolution cells: along velocity the change of a ridge's velocity over these
// ranges in waves of 4 m, along range the correlation length of texture. The optimum is flat between 4 and 7 velocities
// and 5 and 9 ranges; with 3 velocities seven of 100 maps of these waves contain a false centre instead of one.
constexpr double kHalfVelocities = 5;
constexpr double kHalfRanges = 5;
// Points whose power is this many times the rest explain their surroundings; the strongest is excluded, since it would
// protect clutter around it. With 2, twelve of 100 maps of shape 0.5 contain a false centre instead of one; with 4,
// ships lose 1.2 times as many centres 20 dB above clutter, without this rule five times as many.
constexpr double kPointsOverRest = 3;
// Quantiles over the ranges of the swath. With 20 and 50 %, ships that fill half of the ranges or more lose 1.4 times
// as many centres 20 dB above clutter.
constexpr double kLowQuantile = 0.1;
constexpr double kQuantile = 0.3;
// Exponent that extrapolates the two quantiles to 90 % of a log-normal distribution, (z90 - z30) / (z30 - z10) with
// standard normal deviates z. To 80 %, seven of 100 maps of shape 0.5 contain a false centre instead of one; to 95 %,
// ships lose 1.1 times as many centres 20 dB above clutter, without the swath's level three times near broadside.
constexpr double kExtrapolation = (1.2816 + 0.5244) / (1.2816 - 0.5244);
// Texture shape of sea clutter at a resolution of metres (the default of `clutter.texture_shape`).
constexpr double kTextureShape = 2;

struct Cell {
  long v, r;
};

Cell cell_of(const CleanComponent& point, const RvMap& map, const CellSizes& cells) {
  const auto index = [](const std::vector<double>& axis, double value, double step) {
    return std::clamp(std::lround((value - axis.front()) / step), 0L, static_cast<long>(axis.size()) - 1);
  };
  return {index(map.velocity_mps, point.velocity_mps, cells.velocity_mps / cells.velocity_oversampling),
          index(map.range_m, point.range_m, cells.range_m / cells.range_oversampling)};
}

// Rectangle of cells around one, limited to the map; the ends are excluded.
struct Window {
  std::size_t first_v, end_v, first_r, end_r;
};

Window window(const RvMap& map, Cell at, const CellSizes& cells) {
  const long reach_v = std::lround(kHalfVelocities * cells.velocity_oversampling),
             reach_r = std::lround(kHalfRanges * cells.range_oversampling);
  const auto first = [](long centre, long reach) { return static_cast<std::size_t>(std::max(0L, centre - reach)); };
  const auto end = [](long centre, long reach, std::size_t count) {
    return std::min(static_cast<std::size_t>(centre + reach + 1), count);
  };
  return {first(at.v, reach_v), end(at.v, reach_v, map.velocity_mps.size()), first(at.r, reach_r),
          end(at.r, reach_r, map.columns())};
}

// Mean of the largest of n exponentially distributed values of mean 1: 1 + 1/2 + ... + 1/n.
double mean_of_largest(long n) {
  double sum = 0;
  for (long k = 1; k <= n; ++k) sum += 1 / static_cast<double>(k);
  return sum;
}

// Mean power of the ridge that passes through a window: the largest power over velocity at each range, averaged over
// range, relative to its expectation in exponential clutter. The mean of the window itself would include the cells
// beside a narrow or sloping ridge.
double ridge_level(const std::vector<double>& power, std::size_t columns, const Window& in, const CellSizes& cells) {
  double sum = 0;
  for (std::size_t r = in.first_r; r < in.end_r; ++r) {
    double largest = 0;
    for (std::size_t v = in.first_v; v < in.end_v; ++v) largest = std::max(largest, power[v * columns + r]);
    sum += largest;
  }
  const double velocities = static_cast<double>(in.end_v - in.first_v) / cells.velocity_oversampling;
  return sum / static_cast<double>(in.end_r - in.first_r) / mean_of_largest(std::max(1L, std::lround(velocities)));
}

double total_power(const std::vector<double>& power, std::size_t columns, const Window& in) {
  double sum = 0;
  for (std::size_t v = in.first_v; v < in.end_v; ++v) {
    for (std::size_t r = in.first_r; r < in.end_r; ++r) sum += power[v * columns + r];
  }
  return sum;
}

// Level that the ridge exceeds at one range in ten, whatever its velocity there: extrapolated from the 10 % and 30 %
// quantiles over range as of a log-normal distribution, so that a target's own ranges count little. Infinite when
// they are zero.
double swath_level(const std::vector<double>& power, const RvMap& map, const CellSizes& cells) {
  const std::size_t columns = map.columns(), rows = map.velocity_mps.size();
  std::vector<double> largest(columns, 0);
  for (std::size_t v = 0; v < rows; ++v) {
    for (std::size_t r = 0; r < columns; ++r) largest[r] = std::max(largest[r], power[v * columns + r]);
  }
  const long reach = std::lround(kHalfRanges * cells.range_oversampling);
  std::vector<double> levels;
  for (long r = 0; r < static_cast<long>(columns); ++r) {
    const auto first = static_cast<std::size_t>(std::max(0L, r - reach)),
               end = std::min(static_cast<std::size_t>(r + reach + 1), columns);
    double sum = 0;
    for (std::size_t i = first; i < end; ++i) sum += largest[i];
    levels.push_back(sum / static_cast<double>(end - first) / mean_of_largest(2 * std::lround(kHalfVelocities) + 1));
  }
  std::sort(levels.begin(), levels.end());
  const auto quantile = [&](double q) { return levels[static_cast<std::size_t>(q * static_cast<double>(columns))]; };
  const double low = quantile(kLowQuantile), middle = quantile(kQuantile);
  if (!(low > 0)) return std::numeric_limits<double>::infinity();
  return middle * std::pow(middle / low, kExtrapolation);
}

bool near(const CleanComponent& a, const CleanComponent& b, const CellSizes& cells) {
  return std::abs(a.velocity_mps - b.velocity_mps) < (kHalfVelocities + 0.5) * cells.velocity_mps &&
         std::abs(a.range_m - b.range_m) < (kHalfRanges + 0.5) * cells.range_m;
}

// ln of the probability that an intensity of mean 1 exceeds x, K-distributed with this shape: the mean of e^{-x/t} over
// a gamma distributed texture t (Ward, Tough and Watts, "Sea Clutter", 2nd ed. 2013, section 4.6),
// integral of nu^nu t^{nu-1} e^{-nu t - x/t} / Gamma(nu) dt; t = e^s, by the trapezoidal rule, whose error falls
// exponentially here.
double log_exceedance(double x, double shape) {
  constexpr double kStep = 0.1;
  double sum = 0;
  for (int i = -60; i <= 50; ++i) {
    const double s = kStep * i;
    sum += std::exp(shape * s - shape * std::exp(s) - x * std::exp(-s));
  }
  int sign = 1;  // std::lgamma would write it to a global, from several threads
  return shape * std::log(shape) - ::lgamma_r(shape, &sign) + std::log(kStep * sum);
}

}  // namespace

double texture_threshold_margin(double shape, double factor) {
  double below = factor, above = 30 * factor;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (below + above);
    (log_exceedance(middle, shape) > -factor ? below : above) = middle;
  }
  return below / factor;
}

// Censored averaging: accepted targets are excluded from the local level of the others, rejected ones are included
// (Barkat, Himonas and Varshney, "CFAR detection for multiple target situations", IEE Proc. F 136 (1989) 193, who
// censor cells in the order of their power; here points in the order of theirs). The smaller of a near and a far level
// is that of Trunk, "Range resolution of targets using automatic detectors", IEEE Trans. Aerosp. Electron. Syst. 14
// (1978) 750, the far one an ordered statistic (Rohling, the same journal 19 (1983) 608).
std::vector<bool> exceeds_local_level(std::span<const CleanComponent> points, const RvMap& residual,
                                      const std::vector<double>& floor, double factor, double min_power,
                                      const CellSizes& cells) {
  const double margin = texture_threshold_margin(kTextureShape, factor);
  const std::size_t columns = residual.columns();
  const bool has_surroundings = residual.velocity_mps.size() >= kMinCells && columns >= kMinCells;
  std::vector<double> power(residual.values.size());
  for (std::size_t i = 0; i < power.size(); ++i) power[i] = std::norm(residual.values[i]);

  // A point's power along range, and in all cells of the map.
  const double along_range = cells.lobe_ranges * cells.range_oversampling;
  const double lobe = along_range * cells.lobe_velocities * cells.velocity_oversampling;
  std::vector<double> squared, unexplained;
  std::vector<std::size_t> cell;
  std::vector<Window> around;
  for (const CleanComponent& point : points) {
    const Cell at = cell_of(point, residual, cells);
    squared.push_back(std::norm(point.amplitude_m));
    cell.push_back(static_cast<std::size_t>(at.v) * columns + static_cast<std::size_t>(at.r));
    around.push_back(window(residual, at, cells));
    unexplained.push_back(total_power(power, columns, around.back()));
  }
  double swath = std::numeric_limits<double>::infinity();
  if (has_surroundings) {
    std::vector<double> with_points = power;
    for (std::size_t i = 0; i < points.size(); ++i) with_points[cell[i]] += along_range * squared[i];
    swath = swath_level(with_points, residual, cells);
  }

  std::vector<bool> stays(points.size(), true);
  const auto level = [&](std::size_t i) {
    const double global = floor[cell[i]];
    if (!has_surroundings || squared[i] >= factor * margin * swath) return global;
    double explained = 0, strongest = 0, rest = unexplained[i];
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!near(points[k], points[i], cells)) continue;
      (stays[k] ? explained : rest) += lobe * squared[k];
      if (stays[k]) strongest = std::max(strongest, lobe * squared[k]);
    }
    if (explained - strongest > kPointsOverRest * rest) return global;
    return std::max(global, margin * ridge_level(power, columns, around[i], cells));
  };

  // Weakest first, since its rejection raises the local level of its neighbours; until all remaining points are
  // accepted.
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return squared[a] < squared[b]; });
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::size_t i : order) {
      if (!stays[i] || (squared[i] >= min_power && squared[i] >= factor * level(i))) continue;
      stays[i] = false;
      power[cell[i]] += along_range * squared[i];
      changed = true;
    }
  }
  return stays;
}

}  // namespace seaglint

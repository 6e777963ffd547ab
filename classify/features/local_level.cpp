// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/local_level.h"

#include <algorithm>
#include <cmath>

#include "classify/features/residual_floor.h"

namespace seaglint {
namespace {

// Half widths of the surroundings, in resolution cells. Along velocity the width of a ridge of 0.2 m/s, along range
// about the correlation length of texture (five cells). With 8 or 10 ranges two or three times as many maps of waves
// contain a false centre; with 10, half as many weak centres of ships are lost.
constexpr double kHalfVelocities = 2;
constexpr double kHalfRanges = 6;
// Points whose power is this many times the rest explain their surroundings; the strongest is excluded, since it would
// protect clutter around it. Holds for 77 to 80 % of the tests of points on ships and for at most 0.2 % of those of
// clutter peaks (3 % for texture of shape 0.5 or a spread of 0.05 m/s). With 2, three times as many maps of shape 0.5
// contain a false centre; with 6, ships lose 1.3 to 2 times as many weak centres.
constexpr double kPointsOverRest = 3;
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

// Summed power of the residual around a cell, and the number of cells.
struct Surroundings {
  double power = 0, count = 0;
};

Surroundings surroundings(const RvMap& map, Cell at, const CellSizes& cells) {
  const long reach_v = std::lround(kHalfVelocities * cells.velocity_oversampling),
             reach_r = std::lround(kHalfRanges * cells.range_oversampling);
  const long rows = static_cast<long>(map.velocity_mps.size()), columns = static_cast<long>(map.columns());
  Surroundings sum;
  for (long v = std::max(0L, at.v - reach_v); v <= std::min(rows - 1, at.v + reach_v); ++v) {
    for (long r = std::max(0L, at.r - reach_r); r <= std::min(columns - 1, at.r + reach_r); ++r) {
      sum.power += std::norm(map.at(static_cast<std::size_t>(v), static_cast<std::size_t>(r)));
      ++sum.count;
    }
  }
  return sum;
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
  const double step = 0.1;
  double sum = 0;
  for (double s = -6; s <= 5; s += step) sum += std::exp(shape * s - shape * std::exp(s) - x * std::exp(-s));
  int sign = 1;  // std::lgamma would write it to a global, from several threads
  return shape * std::log(shape) - ::lgamma_r(shape, &sign) + std::log(step * sum);
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

// Censored cell averaging: accepted targets are excluded from the local level of the others, rejected ones are included
// (Barkat, Himonas and Varshney, "CFAR detection for multiple target situations", IEE Proc. F 136 (1989) 193, who
// censor cells in the order of their power; here points in the order of theirs).
std::vector<bool> exceeds_local_level(std::span<const CleanComponent> points, const RvMap& residual,
                                      const std::vector<double>& floor, double factor, double min_power,
                                      const CellSizes& cells) {
  const double margin = texture_threshold_margin(kTextureShape, factor);
  const double lobe = cells.lobe_cells * cells.range_oversampling * cells.velocity_oversampling;
  const bool has_surroundings = residual.velocity_mps.size() >= kMinCells && residual.columns() >= kMinCells;
  std::vector<Cell> at;
  std::vector<Surroundings> rest;
  for (const CleanComponent& point : points) {
    at.push_back(cell_of(point, residual, cells));
    rest.push_back(surroundings(residual, at.back(), cells));
  }

  std::vector<bool> stays(points.size(), true);
  const auto level = [&](std::size_t i) {
    const auto v = static_cast<std::size_t>(at[i].v), r = static_cast<std::size_t>(at[i].r);
    const double global = floor[v * residual.columns() + r];
    if (!has_surroundings) return global;
    double explained = 0, strongest = 0, left = rest[i].power;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!near(points[k], points[i], cells)) continue;
      const double power = lobe * std::norm(points[k].amplitude_m);
      (stays[k] ? explained : left) += power;
      if (stays[k]) strongest = std::max(strongest, power);
    }
    if (explained - strongest > kPointsOverRest * left) return global;
    return std::max(global, margin * left / rest[i].count);
  };

  // Weakest first, since its rejection raises the local level of its neighbours; until all remaining points are
  // accepted.
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::norm(points[a].amplitude_m) < std::norm(points[b].amplitude_m);
  });
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::size_t i : order) {
      const double power = std::norm(points[i].amplitude_m);
      if (!stays[i] || (power >= min_power && power >= factor * level(i))) continue;
      stays[i] = false;
      changed = true;
    }
  }
  return stays;
}

}  // namespace seaglint

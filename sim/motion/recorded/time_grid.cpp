// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/recorded/time_grid.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/text/number.h"

namespace seaglint {
namespace {

// Half of the range of t_n - n h, the least distance of all times from a grid of step h.
double deviation_from(const std::vector<double>& time, double step) {
  double lowest = 0, highest = 0;  // relative to the first time
  for (std::size_t n = 0; n < time.size(); ++n) {
    const double residual = time[n] - time.front() - static_cast<double>(n) * step;
    lowest = std::min(lowest, residual);
    highest = std::max(highest, residual);
  }
  return 0.5 * (highest - lowest);
}

// Whether a grid lies within `rounding` of all times. The deviation is convex in the step: golden sections find its
// minimum.
bool lie_on_a_grid(const std::vector<double>& time, double rounding) {
  constexpr double kGolden = 0.6180339887498949;
  const auto last = static_cast<double>(time.size() - 1);
  const double span = time.back() - time.front();
  const double limit = rounding + 1e-9 * span / last;
  double low = (span - 2 * rounding) / last, high = (span + 2 * rounding) / last;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = deviation_from(time, left), at_right = deviation_from(time, right);
  for (int i = 0; i < 60 && std::min(at_left, at_right) > limit; ++i) {
    if (at_left < at_right) {
      high = right, right = left, at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = deviation_from(time, left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = deviation_from(time, right);
    }
  }
  return std::min(at_left, at_right) <= limit;
}

}  // namespace

double rounding_of(const TextTable& table, std::size_t column) {
  int decimals = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::optional<int> own = significant_decimals(table.text(row, column));
    if (!own) return 0;
    decimals = std::max(decimals, *own);
  }
  return 0.5 * std::pow(10.0, -decimals);
}

TimeGrid make_uniform(std::vector<double>& time, double rounding) {
  constexpr double kUniform = 1e-3, kMostRounding = 0.35;  // of a step
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  double smallest = step, largest = step;
  for (std::size_t n = 1; n < time.size(); ++n) {
    smallest = std::min(smallest, time[n] - time[n - 1]);
    largest = std::max(largest, time[n] - time[n - 1]);
  }
  if (largest - smallest <= kUniform * step) return TimeGrid::kUniform;
  if (rounding > kMostRounding * step || !lie_on_a_grid(time, rounding)) return TimeGrid::kIrregular;
  for (std::size_t n = 1; n + 1 < time.size(); ++n) time[n] = time.front() + step * static_cast<double>(n);
  return TimeGrid::kRounded;
}

}  // namespace seaglint

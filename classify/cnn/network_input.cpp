// SPDX-License-Identifier: BSD-3-Clause
#include "classify/cnn/network_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

// The cells [begin, end) that window i of `windows` averages; with few cells, windows overlap or repeat.
struct Window {
  std::size_t begin = 0;
  std::size_t end = 0;
};

Window window(std::size_t i, std::size_t windows, std::size_t cells) {
  return {i * cells / windows, ((i + 1) * cells + windows - 1) / windows};
}

}  // namespace

std::vector<float> network_input(std::span<const float> magnitude, std::size_t rows, std::size_t columns,
                                 double floor_db) {
  SEAGLINT_CHECK(magnitude.size() == rows * columns && rows > 0 && columns > 0 && floor_db < 0,
                 fmt::format("{} values for {} x {}, floor {} dB", magnitude.size(), rows, columns, floor_db));
  std::vector<double> power(kInputCells);
  double total = 0;
  for (std::size_t i = 0; i < kInputRows; ++i) {
    const Window v = window(i, kInputRows, rows);
    for (std::size_t k = 0; k < kInputColumns; ++k) {
      const Window r = window(k, kInputColumns, columns);
      double sum = 0;
      for (std::size_t row = v.begin; row < v.end; ++row) {
        for (std::size_t column = r.begin; column < r.end; ++column) {
          const double value = magnitude[row * columns + column];
          sum += value * value;
        }
      }
      power[i * kInputColumns + k] = sum / static_cast<double>((v.end - v.begin) * (r.end - r.begin));
      total += power[i * kInputColumns + k];
    }
  }

  std::vector<float> input(kInputCells, 0.0f);
  if (total <= 0) return input;
  for (std::size_t i = 0; i < kInputCells; ++i) {
    const double level_db = 10 * std::log10(std::max(power[i] / total, 1e-30));
    input[i] = static_cast<float>(1 - std::max(level_db, floor_db) / floor_db);
  }
  return input;
}

}  // namespace seaglint

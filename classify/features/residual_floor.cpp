// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/residual_floor.h"

#include <algorithm>
#include <cmath>

namespace seaglint {
namespace {

// A target may occupy three quarters of a row (144 m of 192 m), a column rarely to a half.
constexpr double kRowQuantile = 0.2;
constexpr double kColumnQuantile = 0.5;
constexpr double kMapQuantile = 0.5;
constexpr double kFalseMaps = 0.01;
// A maximum is the highest of all positions inside its cell: four times as many independent trials.
constexpr double kPositionsPerCell = 4;

// Mean of an exponential distribution from its quantile.
double mean_from_quantile(std::vector<double> powers, double quantile) {
  const auto at = powers.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(powers.size()));
  std::nth_element(powers.begin(), at, powers.end());
  return *at / -std::log(1 - quantile);
}

}  // namespace

std::vector<double> residual_floor(const RvMap& residual) {
  const std::size_t rows = residual.velocity_mps.size(), columns = residual.columns();
  std::vector<double> powers(rows * columns);
  for (std::size_t i = 0; i < powers.size(); ++i) powers[i] = std::norm(residual.values[i]);

  const double all = mean_from_quantile(powers, kMapQuantile);
  std::vector<double> row(rows, 0), column(columns, 0), line;
  for (std::size_t v = 0; v < rows && columns >= kMinCells; ++v) {
    line.assign(&powers[v * columns], &powers[v * columns] + columns);
    row[v] = mean_from_quantile(line, kRowQuantile);
  }
  for (std::size_t r = 0; r < columns && rows >= kMinCells; ++r) {
    line.clear();
    for (std::size_t v = 0; v < rows; ++v) line.push_back(powers[v * columns + r]);
    column[r] = mean_from_quantile(line, kColumnQuantile);
  }
  std::vector<double> floor(powers.size());
  for (std::size_t v = 0; v < rows; ++v) {
    for (std::size_t r = 0; r < columns; ++r) {
      floor[v * columns + r] = std::max({all, column[r], row[v], column[r] + row[v] - all});
    }
  }
  return floor;
}

double threshold_factor(double cells) { return std::log(std::max(1.0, cells) * kPositionsPerCell / kFalseMaps); }

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "classify/cnn/network_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "classify/features/feature_vector.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

constexpr double kOverviewRange_m = 96;  // half of the default map.range_span_m
constexpr double kVelocity_mps = 1;      // floats at Hs 2 m stay below 0.5 m/s
constexpr double kZoomSpreads = 2.5;
constexpr double kLeastSpread_m = 1;
constexpr double kLinearUpTo_mps = 0.01;  // of the asinh axis; some errors of a centre 30 dB above the clutter
constexpr double kBlur = 0.8;             // cells; a narrower Gaussian loses the place between two cells
constexpr int kBlurReach = 3;             // cells, 9e-4 of its height

// Position of x in -1..1 on an axis of `cells` cells.
double place(double x, std::size_t cells, double offset) {
  const auto count = static_cast<double>(cells);
  return std::clamp(0.5 * (x + 1) * count - 0.5 + offset, 0.0, count - 1);
}

// Raises the plane to a Gaussian of this height about (row, column).
void draw(float* plane, double row, double column, double height) {
  const int row_0 = static_cast<int>(std::lround(row)), column_0 = static_cast<int>(std::lround(column));
  for (int i = std::max(row_0 - kBlurReach, 0); i <= std::min(row_0 + kBlurReach, static_cast<int>(kInputRows) - 1);
       ++i) {
    for (int k = std::max(column_0 - kBlurReach, 0);
         k <= std::min(column_0 + kBlurReach, static_cast<int>(kInputColumns) - 1); ++k) {
      const double square = (i - row) * (i - row) + (k - column) * (k - column);
      float& cell = plane[static_cast<std::size_t>(i) * kInputColumns + static_cast<std::size_t>(k)];
      cell = std::max(cell, static_cast<float>(height * std::exp(-0.5 * square / (kBlur * kBlur))));
    }
  }
}

}  // namespace

std::vector<float> network_input(std::span<const ScatteringCentre> centres, double floor_db,
                                 const ImageOffset& offset) {
  SEAGLINT_CHECK(floor_db < 0, fmt::format("floor {} dB", floor_db));
  std::vector<float> input(kInputCells, 0.0f);
  double power = 0, sum = 0, mean_r = 0, mean_v = 0, variance_r = 0;
  for (const ScatteringCentre& centre : centres) {
    power += centre.amplitude_m * centre.amplitude_m;
    sum += centre.amplitude_m;
    mean_r += centre.amplitude_m * centre.range_m;
    mean_v += centre.amplitude_m * centre.velocity_mps;
  }
  if (!(power > 0)) return input;
  mean_r /= sum;
  mean_v /= sum;
  for (const ScatteringCentre& centre : centres)
    variance_r += centre.amplitude_m / sum * (centre.range_m - mean_r) * (centre.range_m - mean_r);
  const double zoom_m = kZoomSpreads * std::max(std::sqrt(variance_r), kLeastSpread_m);
  const VelocityLine line = robust_velocity_line(centres);

  float* const overview = input.data();
  float* const zoom = input.data() + kInputRows * kInputColumns;
  for (const ScatteringCentre& centre : centres) {
    const double level_db = 20 * std::log10(std::max(centre.amplitude_m / std::sqrt(power), 1e-15));
    const double height = std::max(1 - level_db / floor_db, 0.0);
    const double range_m = centre.range_m - mean_r;
    draw(overview, place((centre.velocity_mps - mean_v) / kVelocity_mps, kInputRows, offset.rows),
         place(range_m / kOverviewRange_m, kInputColumns, offset.columns), height);
    const double residual =
        std::asinh(line.residual(centre) / kLinearUpTo_mps) / std::asinh(kVelocity_mps / kLinearUpTo_mps);
    draw(zoom, place(residual, kInputRows, offset.rows), place(range_m / zoom_m, kInputColumns, offset.columns),
         height);
  }
  return input;
}

CentreList observed_otherwise(std::span<const ScatteringCentre> centres, Random& random) {
  const double side = random.below(2) == 0 ? 1 : -1;
  const double range_factor = side * (0.8 + 0.45 * random.uniform());
  const double velocity_factor = random.below(2) == 0 ? 1 : -1;
  const double rotation_rad_s = 0.00125 * random.normal();
  CentreList changed(centres.begin(), centres.end());
  double mean_m = 0;
  for (ScatteringCentre& centre : changed) {
    centre.range_m *= range_factor;
    mean_m += centre.range_m / static_cast<double>(changed.size());
  }
  for (ScatteringCentre& centre : changed)
    centre.velocity_mps = velocity_factor * centre.velocity_mps + rotation_rad_s * (centre.range_m - mean_m);
  return changed;
}

CentreList with_errors(CentreList centres, Random& random) {
  for (ScatteringCentre& centre : centres) {
    centre.range_m += 0.02 * random.normal();
    centre.velocity_mps += 0.001 * random.normal();
    centre.amplitude_m *= std::pow(10, 0.05 * random.normal());
  }
  return centres;
}

ImageOffset random_offset(Random& random) {
  ImageOffset offset;
  offset.columns = 4 * random.uniform() - 2;
  offset.rows = random.uniform() - 0.5;
  return offset;
}

}  // namespace seaglint

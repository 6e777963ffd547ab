// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/rv_figure.h"

#include <algorithm>
#include <cmath>

namespace seaglint {

Heatmap rv_figure(const RvMap& map, std::span<const ScatteringCentre> centres, const std::string& title,
                  double floor_db) {
  double peak = 0;
  for (const Complex& value : map.values) peak = std::max(peak, std::abs(value));
  Heatmap figure;
  figure.title = title;
  figure.x.label = "range against the reference point (m), positive = farther";
  figure.y.label = "velocity (m/s), positive = receding";
  figure.colour = {"|RV| against the peak (dB)", AxisRange{floor_db, 0}, false};
  figure.x_cells = map.range_m;
  figure.y_cells = map.velocity_mps;
  for (const Complex& value : map.values) {
    const double ratio = peak > 0 ? std::abs(value) / peak : 0;
    figure.values.push_back(ratio > 0 ? std::max(floor_db, 20 * std::log10(ratio)) : floor_db);
  }
  for (const ScatteringCentre& centre : centres) figure.markers.push_back({centre.range_m, centre.velocity_mps});
  figure.marker_name = "scattering centres";
  return figure;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/sea_reflectivity.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {

double nrl_reflectivity_db(Polarisation polarisation, double grazing_rad, double frequency_hz, double sea_state) {
  SEAGLINT_CHECK(polarisation == Polarisation::kHh || polarisation == Polarisation::kVv, "the model knows hh and vv");
  const bool hh = polarisation == Polarisation::kHh;
  const std::array<double, 5> c =
      hh ? std::array{-73.00, 20.78, 7.351, 25.65, 0.00540} : std::array{-50.79, 25.93, 0.7093, 21.58, 0.00211};
  const double alpha = degrees(grazing_rad), f = frequency_hz * 1e-9;
  return c[0] + c[1] * std::log10(std::sin(grazing_rad)) + (27.5 + c[2] * alpha) * std::log10(f) / (1 + 0.95 * alpha) +
         c[3] * std::pow(1 + sea_state, 1 / (2 + 0.085 * alpha + 0.033 * sea_state)) + c[4] * alpha * alpha;
}

double douglas_sea_state(double significant_wave_height_m) {
  constexpr std::array kUpperLimit{0.1, 0.5, 1.25, 2.5, 4.0, 6.0};  // m, upper limits of classes 1 to 6
  SEAGLINT_CHECK(significant_wave_height_m >= 0 && significant_wave_height_m <= kUpperLimit.back(),
                 fmt::format("{} m", significant_wave_height_m));
  double lower = 0, state = 0;
  for (const double upper : kUpperLimit) {
    const double width = state == 0 ? 1.5 : 1;  // 0 m is 0, the upper limit of class 1 is 1.5
    if (significant_wave_height_m <= upper)
      return state + width * (significant_wave_height_m - lower) / (upper - lower);
    state += width;
    lower = upper;
  }
  return state;
}

double clutter_patch_area_m2(const RadarSpec& radar, double grazing_rad, double range_extent_m) {
  const double two_way_rad = radians(radar.link_budget.beamwidth_deg) * std::sqrt(kPi / (8 * std::log(2.0)));
  return radar.range_km * 1e3 * two_way_rad * range_extent_m / std::cos(grazing_rad);
}

}  // namespace seaglint

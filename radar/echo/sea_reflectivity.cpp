// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/sea_reflectivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

double decibels(double power) { return 10 * std::log10(power); }

double nrl_db(const SeaIllumination& sea, bool hh) {
  const std::array<double, 5> c =
      hh ? std::array{-73.00, 20.78, 7.351, 25.65, 0.00540} : std::array{-50.79, 25.93, 0.7093, 21.58, 0.00211};
  const double alpha = degrees(sea.grazing_rad), f = sea.frequency_hz * 1e-9, state = sea.sea_state;
  return c[0] + c[1] * std::log10(std::sin(sea.grazing_rad)) +
         (27.5 + c[2] * alpha) * std::log10(f) / (1 + 0.95 * alpha) +
         c[3] * std::pow(1 + state, 1 / (2 + 0.085 * alpha + 0.033 * state)) + c[4] * alpha * alpha;
}

double git_db(const SeaIllumination& sea, bool hh) {
  // Wind of a fully developed sea of this state, m/s, and mean height of its waves, m (Horst et al., U = 8.67 h^0.4).
  const double wind = 3.16 * std::pow(sea.sea_state, 0.8), height = std::pow(wind / 8.67, 2.5);
  const double alpha = sea.grazing_rad, lambda = kSpeedOfLight / sea.frequency_hz, ghz = 1e-9 * sea.frequency_hz;
  const double roughness = std::pow((14.4 * lambda + 5.5) * alpha * height / lambda, 4);
  const double interference = roughness / (1 + roughness), wind_speed = 1.94 * wind / (1 + wind / 15.4);
  const double direction = sea.upwind_cosine * (1 - 2.8 * alpha);
  if (ghz < 10) {
    const double power = std::pow(lambda + 0.015, -0.4);
    const double level = decibels(3.9e-6 * lambda * std::pow(alpha, 0.4) * interference *
                                  std::exp(0.2 * direction * power) * std::pow(wind_speed, 1.1 * power));
    if (hh) return level;
    if (ghz < 3)
      return level - 1.73 * std::log(height + 0.015) + 3.76 * std::log(lambda) + 2.46 * std::log(alpha + 1e-4) + 22.2;
    return level - 1.05 * std::log(height + 0.015) + 1.09 * std::log(lambda) + 1.27 * std::log(alpha + 1e-4) + 9.70;
  }
  const double level =
      decibels(5.78e-6 * std::pow(alpha, 0.547) * interference * std::exp(0.25 * direction * std::pow(lambda, -0.33)) *
               std::pow(wind_speed, 1.93 * std::pow(lambda, -0.04)));
  return hh ? level : level - 1.38 * std::log(height) + 3.43 * std::log(lambda) + 1.31 * std::log(alpha) + 18.55;
}

double hyb_db(const SeaIllumination& sea, bool hh) {
  const double ghz = 1e-9 * sea.frequency_hz, lambda = kSpeedOfLight / sea.frequency_hz, state = sea.sea_state;
  const double reference = ghz <= 12.5 ? 24.4 * std::log10(ghz) - 65.2 : 3.25 * std::log10(ghz) - 42.0;
  const double deviation_m = 0.031 * state * state, height_m = 0.08 * state * state;
  // 20 dB per decade of the grazing angle below the transitional angle, 10 dB above it.
  const double lowest = radians(0.1), alpha = std::max(sea.grazing_rad, lowest);
  const double transition = std::max(lowest, std::asin(std::min(1.0, 0.0632 * lambda / deviation_m)));
  const double grazing =
      2 * decibels(std::min(alpha, transition) / lowest) + (alpha > transition ? decibels(alpha / transition) : 0);
  double polarisation = 0;
  if (hh && ghz < 3) {
    polarisation = 1.7 * std::log(height_m + 0.015) - 3.8 * std::log(lambda) - 2.5 * std::log(alpha + 1e-4) - 22.2;
  } else if (hh && ghz <= 10) {
    polarisation = 1.1 * std::log(height_m + 0.015) - 1.1 * std::log(lambda) - 1.3 * std::log(alpha + 1e-4) - 9.7;
  } else if (hh) {
    polarisation = 1.4 * std::log(height_m) - 3.4 * std::log(lambda) - 1.3 * std::log(alpha) - 18.6;
  }
  const double direction = (2 + 1.7 * std::log(0.1 / lambda)) * (sea.upwind_cosine - 1);
  return reference + grazing + 5 * (state - 5) + polarisation + direction;
}

double tsc_db(const SeaIllumination& sea, bool hh) {
  constexpr double kFoot_m = 0.3048;
  const double alpha = sea.grazing_rad, lambda = kSpeedOfLight / sea.frequency_hz / kFoot_m;
  const double deviation_ft = 0.115 * std::pow(sea.sea_state, 1.95), wind_kn = 6.2 * std::pow(sea.sea_state, 0.8);
  const double roughness = std::pow(14.9 * alpha * (deviation_ft + 0.25) / lambda, 1.5);
  const double q = std::pow(alpha, 0.6);
  const auto bend = [&](double at_ft, double power) { return std::pow(1 + std::pow(lambda / at_ft, 3), power); };
  const double exponent = 2.63 * bend(0.03, 0.1) / (bend(0.1, 0.1) * bend(0.3, q / 3) * (1 + 0.35 * q));
  const double direction =
      std::exp(0.3 * sea.upwind_cosine * std::exp(-alpha / 0.17) / std::pow(lambda * lambda + 0.005, 0.2));
  const double level = decibels(1.7e-5 * std::sqrt(alpha) * direction * std::pow((wind_kn + 4) / 15, exponent) *
                                roughness / (1 + roughness) / std::pow(lambda + 0.05, 1.8));
  if (hh) return level;
  const double height = std::log(2.507 * deviation_ft + 0.05), wave = std::log(lambda),
               angle = std::log(std::sin(alpha) + 1e-4);
  return 1e-9 * sea.frequency_hz < 2 ? level - 1.73 * height + 3.76 * wave + 2.46 * angle + 19.8
                                     : level - 1.05 * height + 1.09 * wave + 1.27 * angle + 9.65;
}

}  // namespace

double sea_reflectivity_db(ClutterLevel model, const SeaIllumination& sea) {
  SEAGLINT_CHECK(sea.polarisation == Polarisation::kHh || sea.polarisation == Polarisation::kVv,
                 "the models know hh and vv");
  const bool hh = sea.polarisation == Polarisation::kHh;
  switch (model) {
    case ClutterLevel::kNrl: return nrl_db(sea, hh);
    case ClutterLevel::kGit: return git_db(sea, hh);
    case ClutterLevel::kHyb: return hyb_db(sea, hh);
    case ClutterLevel::kTsc: return tsc_db(sea, hh);
    case ClutterLevel::kScr: break;
  }
  SEAGLINT_CHECK(false, "a level relative to the target has no reflectivity");
  return 0;
}

double sea_state_of(const ClutterSpec& clutter, const ClutterScene& scene) {
  return clutter.sea_state ? *clutter.sea_state : douglas_sea_state(scene.significant_wave_height_m);
}

double sea_reflectivity_db(const ClutterSpec& clutter, const ClutterScene& scene, double frequency_hz) {
  return sea_reflectivity_db(clutter.level, {.polarisation = scene.radar.polarisation,
                                             .grazing_rad = std::asin(scene.r_hat.z()),
                                             .frequency_hz = frequency_hz,
                                             .sea_state = sea_state_of(clutter, scene),
                                             .upwind_cosine = upwind_cosine(scene)});
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

}  // namespace seaglint

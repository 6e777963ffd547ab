// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/clutter_scene.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/sea/wave_field.h"

namespace seaglint {
namespace {

constexpr double kSurfaceTension = 0.074;  // N/m, sea water
constexpr double kWindDrift = 0.03;        // of the wind 10 m above the water
constexpr double kFullyDeveloped = 0.22;   // Hs = 0.22 U^2 / g

// Phase speed of the Bragg-resonant waves, k_B = 2 k cos(grazing).
double bragg_speed_mps(double wavelength_m, double cos_grazing) {
  const double k = 4 * kPi / wavelength_m * cos_grazing;
  return std::sqrt(kGravity / k + kSurfaceTension / kSeaWaterDensity * k);
}

// coth(k h): ratio of horizontal to vertical orbital amplitude at the surface, 1 in deep water.
double orbit_ratio(const WaveComponent& wave, double depth) {
  return 1 / std::tanh(std::min(20.0, wave.wavenumber * depth));
}

// Mean velocity of the water particles at the surface, along the wave direction (Stokes 1847; Phillips, "The Dynamics
// of the Upper Ocean", 2nd ed. 1977, section 3.3):
// a^2 w k cosh(2 k h) / (2 sinh^2 k h) = a^2 w k (1 + coth^2 k h) / 2.
double stokes_drift(const WaveComponent& wave, double depth) {
  const double coth = orbit_ratio(wave, depth);
  return wave.amplitude * wave.amplitude * wave.omega * wave.wavenumber * (1 + coth * coth) / 2;
}

double beam_deviation_rad(const RadarSpec& radar) {
  return radians(radar.link_budget.beamwidth_deg) / (4 * std::sqrt(std::log(2.0)));
}

}  // namespace

VelocityMoments clutter_velocity_moments(const ClutterSpec& spec, const ClutterScene& scene, double wavelength_m) {
  SEAGLINT_CHECK(scene.waves != nullptr, "clutter that follows the sea needs its waves");
  const double cos_grazing = std::hypot(scene.r_hat.x(), scene.r_hat.y()), sin_grazing = scene.r_hat.z();
  const Vec2 look = Vec2(scene.r_hat.x(), scene.r_hat.y());  // norm cos_grazing

  // Orbital velocity of a wave of amplitude a: a w vertical, a w coth(k h) along its direction.
  Vec2 stokes = Vec2::Zero();
  double variance = 0;
  for (const WaveComponent& wave : scene.waves->components()) {
    const double speed = wave.amplitude * wave.omega;
    stokes += stokes_drift(wave, scene.waves->depth()) * wave.direction;
    const double horizontal = look.dot(wave.direction) * orbit_ratio(wave, scene.waves->depth());
    variance += 0.5 * speed * speed * (horizontal * horizontal + sin_grazing * sin_grazing);
  }
  const double past_mps =
      scene.r_hat.dot(scene.target_velocity_mps - scene.current_mps);  // still water moves astern of the target
  if (!(stokes.norm() > 0)) return {past_mps, 0};
  const double wind = developed_wind_mps(scene.significant_wave_height_m);
  const double along_waves = bragg_speed_mps(wavelength_m, cos_grazing) + kWindDrift * wind + stokes.norm();
  const double factor = scene.radar.polarisation == Polarisation::kVv ? 1 : spec.hh_velocity_factor;
  return {past_mps - factor * along_waves * look.dot(stokes.normalized()), std::sqrt(variance)};
}

double platform_doppler_spread_mps(const ClutterScene& scene) {
  const Vec3 velocity = Vec3(scene.radar.platform.velocity_mps) + scene.target_velocity_mps - scene.current_mps;
  const Vec3 sideways = Vec3::UnitZ().cross(scene.r_hat);
  const double level = sideways.norm();
  return level > 0 ? std::abs(velocity.dot(sideways)) / level * beam_deviation_rad(scene.radar) : 0;
}

double beam_deviation_m(const RadarSpec& radar) { return radar.range_km * 1e3 * beam_deviation_rad(radar); }

double upwind_cosine(const ClutterScene& scene) {
  return Vec2(scene.r_hat.x(), scene.r_hat.y())
      .normalized()
      .dot(Vec2(std::cos(scene.waves_towards_rad), std::sin(scene.waves_towards_rad)));
}

double clutter_patch_area_m2(const RadarSpec& radar, double grazing_rad, double range_extent_m) {
  const double two_way_rad = radians(radar.link_budget.beamwidth_deg) * std::sqrt(kPi / (8 * std::log(2.0)));
  return radar.range_km * 1e3 * two_way_rad * range_extent_m / std::cos(grazing_rad);
}

double developed_wind_mps(double significant_wave_height_m) {
  return std::sqrt(kGravity * significant_wave_height_m / kFullyDeveloped);
}

FittedFigure k_shape(const ClutterScene& scene, double frequency_hz, double range_cell_m) {
  const Polarisation polarisation = scene.radar.polarisation;
  const bool is_vv = polarisation == Polarisation::kVv, is_co_polar = is_vv || polarisation == Polarisation::kHh;
  const double grazing_rad = std::asin(scene.r_hat.z()), ghz = 1e-9 * frequency_hz, grazing_deg = degrees(grazing_rad);
  const double area_m2 = clutter_patch_area_m2(scene.radar, grazing_rad, range_cell_m),
               across_m = area_m2 * std::cos(grazing_rad) / range_cell_m;
  const double cosine = upwind_cosine(scene);
  const double logarithm = 2.0 / 3 * std::log10(std::clamp(grazing_deg, 0.1, 10.0)) + 5.0 / 8 * std::log10(area_m2) -
                           (is_vv ? 1.39 : 2.09) - (2 * cosine * cosine - 1) / 3;
  return {std::clamp(std::pow(10, logarithm), 0.1, 1000.0), is_co_polar && ghz >= 9 && ghz <= 10 &&
                                                                grazing_deg >= 0.1 && grazing_deg <= 10 &&
                                                                across_m >= 100 && across_m <= 800};
}

double texture_length_m(const ClutterScene& scene) {
  const double wind = developed_wind_mps(scene.significant_wave_height_m), cosine = upwind_cosine(scene);
  return kPi / 2 * wind * wind / kGravity * std::sqrt(3 * cosine * cosine + 1);
}

TextureParameters texture_parameters(const ClutterSpec& spec, const ClutterScene& scene, double frequency_hz,
                                     double range_cell_m) {
  // 8 m, 1 s and 0.13 m/s are fitted to measured clutter (README.md, "Modulated by the waves"). Five range cells: long
  // compared with the main lobe, so that the texture is constant over a map cell and its intensity has <I^2>/<I>^2 = 2
  // (1 + 1/shape) to about 2 %.
  const bool by_waves = texture_is_by_waves(spec);
  const double shape = spec.texture_shape ? *spec.texture_shape
                       : by_waves         ? k_shape(scene, frequency_hz, range_cell_m).value
                                          : 2;
  return {.shape = shape,
          .correlation_cells = spec.texture_correlation_m ? *spec.texture_correlation_m / range_cell_m
                               : by_waves                 ? 8 / range_cell_m
                                                          : 5,
          .correlation_time_s = spec.texture_correlation_time_s.value_or(by_waves ? 1 : 3),
          .spread_mps = spec.doppler_spread_mps.value_or(by_waves ? 0.13 : 0.5)};
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/clutter_motion.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"

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

// Two-way gain e^{-8 ln2 phi^2 / width^2} is a normal density of deviation width / (4 sqrt(ln 2)).
double beam_deviation_rad(const RadarSpec& radar) {
  return radians(radar.link_budget.beamwidth_deg) / (4 * std::sqrt(std::log(2.0)));
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

// Mean water velocity at the moving surface: the mean of eta1 du1/dz, 1/2 a^2 w k along each component's direction, in
// any depth; the remainder of the Stokes drift, the same times coth^2 kh, is Lagrangian. Zero at order 1.
Vec2 mean_at_the_surface(const WaveField& waves) {
  Vec2 mean = Vec2::Zero();
  for (const WaveComponent& wave : std::span(waves.components()).first(waves.second_order_count()))
    mean += 0.5 * wave.amplitude * wave.amplitude * wave.omega * wave.wavenumber * wave.direction;
  return mean;
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
      scene.r_hat.dot(scene.target_velocity_mps);  // still water moves astern relative to the target
  if (!(stokes.norm() > 0)) return {past_mps, 0};
  const double wind = std::sqrt(kGravity * scene.significant_wave_height_m / kFullyDeveloped);
  const double along_waves = bragg_speed_mps(wavelength_m, cos_grazing) + kWindDrift * wind + stokes.norm();
  const double factor = scene.radar.polarisation == Polarisation::kVv ? 1 : spec.hh_velocity_factor;
  return {past_mps - factor * along_waves * look.dot(stokes.normalized()), std::sqrt(variance)};
}

double platform_doppler_spread_mps(const ClutterScene& scene) {
  const Vec3 velocity = Vec3(scene.radar.platform.velocity_mps) + scene.target_velocity_mps;
  const Vec3 sideways = Vec3::UnitZ().cross(scene.r_hat);
  const double level = sideways.norm();
  return level > 0 ? std::abs(velocity.dot(sideways)) / level * beam_deviation_rad(scene.radar) : 0;
}

FloatingScatterers floating_scatterers(const ClutterScene& scene, const std::vector<double>& range_m, double duration_s,
                                       std::uint64_t seed, std::uint64_t index) {
  SEAGLINT_CHECK(scene.waves != nullptr && duration_s > 0, "clutter on the waves needs waves and an interval");
  Random random({seed, Stream::kClutterPlace, index});
  const double cos_grazing = std::hypot(scene.r_hat.x(), scene.r_hat.y());
  const Vec2 away = -Vec2(scene.r_hat.x(), scene.r_hat.y()) / cos_grazing, across(-away.y(), away.x());
  const double deviation_m = scene.radar.range_km * 1e3 * beam_deviation_rad(scene.radar);
  const Vec2 sailed_m = scene.start_s * scene.target_velocity_mps.xy();  // position of the target in the waves
  const Vec2 mean = mean_at_the_surface(*scene.waves);
  FloatingScatterers floating;
  for (const double range : range_m) {
    const Vec2 place = sailed_m + away * (range / cos_grazing) + across * (deviation_m * random.normal());
    const auto radial = [&](double time_s) {
      const Vec3 velocity = scene.waves->surface(place.x(), place.y(), time_s).velocity;
      return -scene.r_hat.dot(velocity - Vec3(mean.x(), mean.y(), 0));
    };
    const double first = radial(scene.start_s), last = radial(scene.start_s + duration_s);
    floating.velocity_mps.push_back(first);
    floating.acceleration_mps2.push_back((last - first) / duration_s);
  }
  return floating;
}

}  // namespace seaglint

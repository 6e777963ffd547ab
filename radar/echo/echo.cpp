// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/echo.h"

#include <fmt/format.h>

#include <cmath>

#include "radar/echo/receiver_noise.h"
#include "radar/echo/sea_clutter.h"
#include "radar/echo/sea_reflectivity.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"

namespace seaglint {

double mean_power(std::span<const Complex> values) {
  double sum = 0;
  for (const Complex& value : values) sum += std::norm(value);
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

std::vector<Complex> Echo::total() const {
  std::vector<Complex> sum = target;
  for (std::size_t i = 0; i < clutter.size(); ++i) sum[i] += clutter[i];
  for (std::size_t i = 0; i < noise.size(); ++i) sum[i] += noise[i];
  return sum;
}

namespace {

// Unscaled clutter echo: in m^2 per frequency for level nrl, else of mean power 1.
std::vector<Complex> clutter_echo(const PulseTrain& train, const ClutterSpec& clutter, const ClutterScene& scene,
                                  std::uint64_t seed, std::uint64_t index) {
  double power = 1;
  if (clutter.level == ClutterLevel::kNrl) {
    const double grazing = std::asin(scene.r_hat.z());
    const double state = clutter.sea_state.value_or(douglas_sea_state(scene.significant_wave_height_m));
    const double sigma0 =
        std::pow(10, nrl_reflectivity_db(scene.radar.polarisation, grazing, train.band_centre_hz(), state) / 10);
    const double window_m = train.unambiguous_range_m() / train.grid_refinement;
    power = sigma0 * clutter_patch_area_m2(scene.radar, grazing, window_m) / (4 * kPi);
  }
  std::vector<Complex> echo = clutter_response(train, clutter, scene, seed, index);
  for (std::size_t i = 0; i < echo.size(); ++i)
    echo[i] *= std::sqrt(power) * train.chirp_spectrum[i % train.frequencies()];
  return echo;
}

// White complex Gaussian noise over the band, mean power 1.
std::vector<Complex> white_noise(std::size_t size, std::uint64_t seed, std::uint64_t index) {
  Random random({seed, Stream::kNoise, index});
  std::vector<Complex> noise;
  noise.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const double re = random.normal();
    noise.push_back(Complex(re, random.normal()) * std::sqrt(0.5));
  }
  return noise;
}

// Phase of the radar's own motion relative to the reference point, unless motion-compensated: range R(t) - R(0), R(t) =
// |R_0 r^ + u t|.
void add_own_motion(std::vector<Complex>& echo, const PulseTrain& train, const ClutterScene& scene) {
  const PlatformSpec& platform = scene.radar.platform;
  const Vec3 velocity(platform.velocity_mps);
  if (platform.motion_compensated || velocity.isZero(0)) return;
  const double start_m = scene.radar.range_km * 1e3;
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    for (std::size_t b = 0; b < train.frequencies(); ++b) {
      const double t = train.time_s[n] + (train.intra_pulse_motion ? train.baseband_hz[b] / train.chirp_rate_hz_s : 0);
      const double along = scene.r_hat.dot(velocity) * t, distance2 = velocity.squaredNorm() * t * t;
      const double now_m = std::sqrt(start_m * start_m + 2 * start_m * along + distance2);
      const double farther_m = (2 * start_m * along + distance2) / (now_m + start_m);
      echo[n * train.frequencies() + b] *=
          std::polar(1.0, -4 * kPi * (train.carrier_hz[n] + train.baseband_hz[b]) * farther_m / kSpeedOfLight);
    }
  }
}

void scale(std::vector<Complex>& values, double power_gain) {
  for (Complex& value : values) value *= std::sqrt(power_gain);
}

double ratio(double db) { return std::pow(10, db / 10); }

}  // namespace

Echo synthesise_echo(const PulseTrain& train, const FrequencyResponse& response, const ClutterSpec& clutter,
                     std::uint64_t seed, std::uint64_t index, const ClutterScene& scene) {
  const std::size_t frequencies = train.frequencies();
  SEAGLINT_CHECK(response.values.size() == train.pulses() * frequencies,
                 fmt::format("response of {} values for {} pulses x {} frequencies", response.values.size(),
                             train.pulses(), frequencies));
  Echo echo;
  echo.pulses = static_cast<int>(train.pulses());
  echo.frequencies = static_cast<int>(frequencies);
  echo.target.resize(response.values.size());
  for (std::size_t i = 0; i < echo.target.size(); ++i)
    echo.target[i] = train.chirp_spectrum[i % frequencies] * response.values[i];
  const double target_power = mean_power(echo.target);
  if (!(target_power > 0) || !std::isfinite(target_power)) {
    throw InputError(fmt::format(
        "the target's echo has no power (mean {} m^2): nothing faces the radar, or the polarisation is not returned",
        target_power));
  }

  add_own_motion(echo.target, train, scene);
  if (clutter.enabled) {
    echo.clutter = clutter_echo(train, clutter, scene, seed, index);
    add_own_motion(echo.clutter, train, scene);
    if (clutter.level == ClutterLevel::kScr)
      scale(echo.clutter, target_power / mean_power(echo.clutter) / ratio(clutter.scr_db));
  }
  if (clutter.noise_level == NoiseLevel::kCnr && echo.clutter.empty()) return echo;
  echo.noise = white_noise(echo.target.size(), seed, index);
  switch (clutter.noise_level) {
    case NoiseLevel::kCnr:
      scale(echo.noise, mean_power(echo.clutter) / mean_power(echo.noise) * ratio(-clutter.cnr_db));
      break;
    case NoiseLevel::kSnr: scale(echo.noise, target_power / mean_power(echo.noise) / ratio(clutter.snr_db)); break;
    case NoiseLevel::kThermal: scale(echo.noise, thermal_noise_m2(train, scene.radar)); break;
  }
  return echo;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/echo.h"

#include <fmt/format.h>

#include <cmath>

#include "radar/echo/sea_clutter.h"
#include "sim/core/error.h"
#include "sim/core/random.h"

namespace seaglint {

double mean_power(std::span<const Complex> values) {
  double sum = 0;
  for (const Complex& value : values) sum += std::norm(value);
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

std::vector<Complex> Echo::total() const {
  std::vector<Complex> sum = target;
  for (std::size_t i = 0; i < clutter.size(); ++i) sum[i] += clutter[i];
  return sum;
}

Echo synthesize_echo(const PulseTrain& train, const FrequencyResponse& response, const ClutterSpec& clutter,
                     std::uint64_t seed, std::uint64_t index) {
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
  if (!clutter.enabled) return echo;

  // Clutter passes through the same transmit waveform; noise is white over the band.
  echo.clutter = clutter_response(train, clutter, seed, index);
  for (std::size_t i = 0; i < echo.clutter.size(); ++i) echo.clutter[i] *= train.chirp_spectrum[i % frequencies];
  const double noise_power = mean_power(train.chirp_spectrum) * std::pow(10, clutter.noise_to_clutter_db / 10);
  Random random({seed, Stream::kNoise, index});
  for (Complex& value : echo.clutter) {
    const double re = random.normal();
    value += Complex(re, random.normal()) * std::sqrt(noise_power / 2);
  }
  const double scale = std::sqrt(target_power / mean_power(echo.clutter) * std::pow(10, -clutter.scr_db / 10));
  for (Complex& value : echo.clutter) value *= scale;
  return echo;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/sampled_echo.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

constexpr double kWhole = 1e-9;  // relative tolerance of ratios that must be integers

double whole_ratio(double numerator, double denominator) {
  const double ratio = numerator / denominator;
  return std::abs(ratio - std::round(ratio)) < kWhole * ratio ? std::round(ratio) : 0;
}

// Frequencies f_b = (b - (F - 1)/2) step and times t_k = (k - (L - 1)/2) / fs with fs = L step:
//   f_b t_k = (b k - b (L - 1)/2 - k (F - 1)/2 + (F - 1)(L - 1)/4) / L,
// a transform of length L between factors of b alone and of k alone.
struct CentredTransform {
  double frequencies, samples;

  Complex of_frequency(double b, double sign) const {
    return std::polar(1.0, sign * kPi * ((frequencies - 1) / 2 - 2 * b) * (samples - 1) / (2 * samples));
  }
  Complex of_sample(double k, double sign) const {
    return std::polar(1.0, sign * kPi * ((samples - 1) / 2 - 2 * k) * (frequencies - 1) / (2 * samples));
  }
};

}  // namespace

PulseTrain train_for_samples(const PulseTrain& train, const RadarSpec& radar) {
  const double sampling_hz = radar.sampling_mhz * 1e6, pulse_s = radar.pulse_width_us * 1e-6;
  const double needed_s = pulse_s + 2 * train.unambiguous_range_m() / kSpeedOfLight;
  const int min_refinement = static_cast<int>(std::ceil(needed_s * train.baseband_step_hz));
  int refinement = min_refinement + (min_refinement + 1) % 2;
  while (whole_ratio(sampling_hz, train.baseband_step_hz / refinement) == 0) {
    refinement += 2;
    if (refinement > 4 * min_refinement) {
      throw InputError(
          fmt::format("radar.sampling_mhz: value {}: must be a multiple of a frequency step below {:.6g} MHz "
                      "for an echo in samples",
                      radar.sampling_mhz, train.baseband_step_hz * 1e-6 / min_refinement));
    }
  }
  PulseTrain fine = train;
  fine.grid_refinement = refinement;
  fine.bins_per_hop *= refinement;
  fine.baseband_step_hz /= refinement;
  const std::size_t frequencies = train.frequencies() * static_cast<std::size_t>(refinement);
  fine.baseband_hz.clear();
  for (std::size_t b = 0; b < frequencies; ++b) {
    fine.baseband_hz.push_back((static_cast<double>(b) + 0.5 - 0.5 * static_cast<double>(frequencies)) *
                               fine.baseband_step_hz);
  }
  fine.chirp_spectrum = chirp_spectrum(train.bandwidth_hz, pulse_s, sampling_hz, fine.baseband_hz);
  return fine;
}

double samples_per_pulse(const PulseTrain& fine, double sampling_hz) {
  return whole_ratio(sampling_hz, fine.baseband_step_hz);
}

SampledEcho sample_echo(const std::vector<Complex>& echo, const PulseTrain& fine, double sampling_hz) {
  const std::size_t frequencies = fine.frequencies();
  const double length = samples_per_pulse(fine, sampling_hz);
  SEAGLINT_CHECK(length >= static_cast<double>(frequencies) && echo.size() == fine.pulses() * frequencies,
                 fmt::format("{} values, {} frequencies, {} samples", echo.size(), frequencies, length));
  SampledEcho sampled;
  sampled.sampling_hz = sampling_hz;
  sampled.pulses = static_cast<int>(fine.pulses());
  for (double k = 0; k < length; ++k) sampled.time_s.push_back((k - (length - 1) / 2) / sampling_hz);

  const CentredTransform centred{static_cast<double>(frequencies), length};
  const double scale = fine.baseband_step_hz / std::sqrt(fine.chirp_rate_hz_s);
  FourierBatch transform(sampled.samples(), 1, Fourier::kInverse);
  Complex* row = transform.row(0);
  for (std::size_t n = 0; n < fine.pulses(); ++n) {
    std::fill(row, row + sampled.samples(), Complex{});
    for (std::size_t b = 0; b < frequencies; ++b)
      row[b] = scale * echo[n * frequencies + b] * centred.of_frequency(static_cast<double>(b), 1);
    transform.execute();
    for (std::size_t k = 0; k < sampled.samples(); ++k)
      sampled.values.push_back(row[k] * centred.of_sample(static_cast<double>(k), 1));
  }
  return sampled;
}

std::vector<Complex> spectrum_of(const SampledEcho& sampled, const PulseTrain& train) {
  const double length = static_cast<double>(sampled.samples());
  const double refinement = whole_ratio(train.baseband_step_hz * length, sampled.sampling_hz);
  SEAGLINT_CHECK(
      std::fmod(refinement, 2) == 1 && static_cast<int>(train.pulses()) == sampled.pulses,
      fmt::format("{} samples at {} Hz for steps of {} Hz", length, sampled.sampling_hz, train.baseband_step_hz));
  const std::size_t frequencies = train.frequencies();
  const CentredTransform centred{static_cast<double>(frequencies) * refinement, length};
  const double scale = std::sqrt(train.chirp_rate_hz_s) / sampled.sampling_hz;
  std::vector<Complex> echo;
  FourierBatch transform(sampled.samples(), 1, Fourier::kForward);
  Complex* row = transform.row(0);
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    for (std::size_t k = 0; k < sampled.samples(); ++k)
      row[k] = sampled.values[n * sampled.samples() + k] * centred.of_sample(static_cast<double>(k), -1);
    transform.execute();
    for (std::size_t b = 0; b < frequencies; ++b) {
      // The middle one of the fine frequencies of a coarse cell.
      const double i = refinement * static_cast<double>(b) + (refinement - 1) / 2;
      echo.push_back(scale * row[static_cast<std::size_t>(i)] * centred.of_frequency(i, -1));
    }
  }
  return echo;
}

}  // namespace seaglint

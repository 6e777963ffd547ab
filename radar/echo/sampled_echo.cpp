// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/sampled_echo.h"

#include <fmt/format.h>

#include <algorithm>
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

// Frequencies f_b = (b - (F - 1)/2) step and times t_k = (k - (L - 1)/2) / fs with fs = P step:
//   f_b t_k = (b k - b (L - 1)/2 - k (F - 1)/2 + (F - 1)(L - 1)/4) / P,
// a transform of length P between factors of b alone and of k alone.
struct CentredTransform {
  double frequencies, samples, period;

  Complex of_frequency(double b, double sign) const {
    return std::polar(1.0, sign * kPi * ((frequencies - 1) / 2 - 2 * b) * (samples - 1) / (2 * period));
  }
  Complex of_sample(double k, double sign) const {
    return std::polar(1.0, sign * kPi * ((samples - 1) / 2 - 2 * k) * (frequencies - 1) / (2 * period));
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
  for (std::size_t k = 0; k < static_cast<std::size_t>(length); ++k)
    sampled.time_s.push_back((static_cast<double>(k) - (length - 1) / 2) / sampling_hz);

  const CentredTransform centred{static_cast<double>(frequencies), length, length};
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
  // Samples apart by a period of the map's grid have the factor 1 at all of its frequencies, -1 for an even number of
  // them, and are summed before the transform. Where that period is no whole number of samples, the middle one of the
  // fine frequencies of each coarse cell is taken of the transform of all.
  const double whole_period = whole_ratio(sampled.sampling_hz, train.baseband_step_hz);
  const double period = whole_period > 0 ? whole_period : length, stride = whole_period > 0 ? 1 : refinement;
  const double alternating = frequencies % 2 == 0 ? -1 : 1;
  const CentredTransform centred{static_cast<double>(frequencies) * stride, length, period};
  const double scale = std::sqrt(train.chirp_rate_hz_s) / sampled.sampling_hz;
  const auto in_period = static_cast<std::size_t>(period);
  std::vector<Complex> of_sample, of_frequency;
  for (std::size_t k = 0; k < in_period; ++k) of_sample.push_back(centred.of_sample(static_cast<double>(k), -1));
  std::vector<std::size_t> place;
  for (std::size_t b = 0; b < frequencies; ++b) {
    const double i = stride * static_cast<double>(b) + (stride - 1) / 2;
    place.push_back(static_cast<std::size_t>(i));
    of_frequency.push_back(scale * centred.of_frequency(i, -1));
  }

  std::vector<Complex> echo;
  FourierBatch transform(in_period, 1, Fourier::kForward);
  Complex* row = transform.row(0);
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    const Complex* const values = &sampled.values[n * sampled.samples()];
    std::copy(values, values + in_period, row);
    double sign = 1;
    for (std::size_t first = in_period; first < sampled.samples(); first += in_period) {
      sign *= alternating;
      for (std::size_t k = 0; k < in_period; ++k) row[k] += sign * values[first + k];
    }
    for (std::size_t k = 0; k < in_period; ++k) row[k] *= of_sample[k];
    transform.execute();
    for (std::size_t b = 0; b < frequencies; ++b) echo.push_back(row[place[b]] * of_frequency[b]);
  }
  return echo;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "radar/waveform/pulse_train.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

// 1 GiB of complex numbers in one echo; a larger interval indicates an error in the scenario.
constexpr double kMaxSamples = 1 << 26;
constexpr double kMaxPulseSamples = 1 << 24;
constexpr double kMaxSpectrumTerms = 4e9;  // pulse samples times frequencies, about ten seconds
// Tolerance of ratios of decimal inputs (25 / 0.625 must be 40).
constexpr double kRatioSlack = 1e-9;

}  // namespace

int PulseTrain::band_bins() const { return (carriers - 1) * bins_per_hop + static_cast<int>(frequencies()); }
double PulseTrain::band_centre_hz() const {
  return first_carrier_hz + baseband_hz.front() + 0.5 * (band_bins() - 1) * baseband_step_hz;
}
double PulseTrain::synthetic_bandwidth_hz() const { return band_bins() * baseband_step_hz; }
double PulseTrain::unambiguous_range_m() const { return kSpeedOfLight / (2 * baseband_step_hz); }
double PulseTrain::range_resolution_m() const { return kSpeedOfLight / (2 * synthetic_bandwidth_hz()); }
double PulseTrain::velocity_resolution_mps() const {
  return kSpeedOfLight / band_centre_hz() / (2 * static_cast<double>(pulses()) * pri_s);
}
double PulseTrain::unambiguous_velocity_mps() const { return kSpeedOfLight / band_centre_hz() / (4 * pri_s); }

std::vector<int> hop_code(HopCode kind, int pulses, int carriers, std::uint64_t seed, std::uint64_t index) {
  Random random({seed, Stream::kHopCode, index});
  std::vector<int> code(pulses);
  for (int n = 0; n < pulses; ++n) {
    code[n] =
        kind == HopCode::kRandom ? static_cast<int>(random.below(static_cast<std::uint32_t>(carriers))) : n % carriers;
  }
  if (kind == HopCode::kBalanced) {
    // The labels are shuffled first, so that the carriers with one pulse more, when M does not divide N, are random.
    std::vector<int> label(carriers);
    for (int i = 0; i < carriers; ++i) label[i] = i;
    const auto shuffle = [&random](std::vector<int>& values) {  // Fisher and Yates
      for (std::size_t last = values.size(); last > 1; --last) {
        std::swap(values[last - 1], values[random.below(static_cast<std::uint32_t>(last))]);
      }
    };
    shuffle(label);
    for (int& c : code) c = label[c];
    shuffle(code);
  }
  return code;
}

std::vector<int> hop_code(const RadarSpec& spec, std::uint64_t seed, std::uint64_t index) {
  if (spec.hop_code != HopCode::kFile) return hop_code(spec.hop_code, spec.pulses, spec.carrier_count, seed, index);
  SEAGLINT_CHECK(spec.hop_codes && spec.hop_codes->size() >= static_cast<std::size_t>(spec.pulses),
                 "a hop code from a file has been read");
  const auto pulses = static_cast<std::size_t>(spec.pulses);
  const std::size_t first = index % (spec.hop_codes->size() / pulses) * pulses;
  const auto begin = spec.hop_codes->begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + spec.pulses};
}

std::vector<double> pulse_times(const RadarSpec& spec, std::uint64_t seed, std::uint64_t index) {
  Random random({seed, Stream::kPriJitter, index});
  std::vector<double> time_s;
  for (int n = 0; n < spec.pulses; ++n) {
    const double early_or_late = n > 0 && spec.pri_jitter_us > 0 ? spec.pri_jitter_us * (2 * random.uniform() - 1) : 0;
    time_s.push_back((n * spec.pri_us + early_or_late) * 1e-6);
  }
  return time_s;
}

std::vector<Complex> chirp_spectrum(double bandwidth_hz, double pulse_width_s, double sampling_hz,
                                    const std::vector<double>& frequency_hz) {
  const double chirp_rate = bandwidth_hz / pulse_width_s;
  const auto samples = static_cast<std::size_t>(std::max(1.0, std::round(pulse_width_s * sampling_hz)));
  const auto time = [&](std::size_t k) { return (static_cast<double>(k) + 0.5) / sampling_hz - 0.5 * pulse_width_s; };
  std::vector<Complex> chirp(samples);
  for (std::size_t k = 0; k < samples; ++k) chirp[k] = std::polar(1.0, kPi * chirp_rate * time(k) * time(k));
  std::vector<Complex> spectrum;
  for (const double f : frequency_hz) {
    // The phase factor is updated by multiplication and recomputed every 64 samples.
    Complex sum;
    const Complex step = std::polar(1.0, -2 * kPi * f / sampling_hz);
    Complex factor;
    for (std::size_t k = 0; k < samples; ++k) {
      factor = k % 64 == 0 ? std::polar(1.0, -2 * kPi * f * time(k)) : factor * step;
      sum += chirp[k] * factor;
    }
    spectrum.push_back(sum * (std::sqrt(chirp_rate) / sampling_hz));
  }
  return spectrum;
}

PulseTrain make_pulse_train(const RadarSpec& spec, double range_window_m, std::uint64_t seed, std::uint64_t index) {
  PulseTrain train;
  train.carriers = spec.carrier_count;
  train.first_carrier_hz = spec.carrier_ghz * 1e9;
  train.hop_step_hz = spec.hop_step_mhz * 1e6;
  train.bandwidth_hz = spec.bandwidth_mhz * 1e6;
  train.pri_s = spec.pri_us * 1e-6;
  train.intra_pulse_motion = spec.intra_pulse_motion;
  const double pulse_width_s = spec.pulse_width_us * 1e-6;
  train.chirp_rate_hz_s = train.bandwidth_hz / pulse_width_s;

  // Bins fine enough that the window c / (2 step) contains the required range and the chirp band contains at least one.
  const double for_window = std::ceil(train.hop_step_hz * 2 * range_window_m / kSpeedOfLight - kRatioSlack);
  const double for_chirp = std::ceil(train.hop_step_hz / train.bandwidth_hz - kRatioSlack);
  const double per_hop = std::max({1.0, for_window, for_chirp});
  const double per_pulse = std::max(1.0, std::floor(train.bandwidth_hz * per_hop / train.hop_step_hz + kRatioSlack));
  const double samples = std::max(per_pulse * spec.pulses, per_hop * spec.carrier_count + per_pulse);
  if (!(samples <= kMaxSamples)) {
    throw InputError(
        fmt::format("radar: a range window of {:.6g} m needs {:.3g} frequency samples per interval; at most {:.0f}: "
                    "reduce pulses, hop_count, hop_step_mhz, bandwidth_mhz or the window",
                    range_window_m, samples, kMaxSamples));
  }
  const double pulse_samples = pulse_width_s * spec.sampling_mhz * 1e6;
  if (!(pulse_samples <= kMaxPulseSamples && pulse_samples * per_pulse <= kMaxSpectrumTerms)) {
    throw InputError(fmt::format(
        "radar: a pulse of {:g} us sampled at {:g} MHz has {:.3g} samples for {:.0f} frequencies; at most "
        "{:.0f} samples and {:.0e} products: reduce pulse_width_us or sampling_mhz",
        spec.pulse_width_us, spec.sampling_mhz, pulse_samples, per_pulse, kMaxPulseSamples, kMaxSpectrumTerms));
  }

  train.bins_per_hop = static_cast<int>(per_hop);
  train.baseband_step_hz = train.hop_step_hz / per_hop;
  train.baseband_hz.resize(static_cast<std::size_t>(per_pulse));
  for (std::size_t b = 0; b < train.baseband_hz.size(); ++b) {
    train.baseband_hz[b] = (static_cast<double>(b) + 0.5 - 0.5 * per_pulse) * train.baseband_step_hz;
  }
  train.chirp_spectrum = chirp_spectrum(train.bandwidth_hz, pulse_width_s, spec.sampling_mhz * 1e6, train.baseband_hz);

  train.code = hop_code(spec, seed, index);
  train.time_s = pulse_times(spec, seed, index);
  for (const int c : train.code) train.carrier_hz.push_back(train.first_carrier_hz + c * train.hop_step_hz);
  return train;
}

IntervalSampling interval_sampling(const PulseTrain& train, double start_s) {
  IntervalSampling sampling;
  sampling.first_hz = train.first_carrier_hz + train.baseband_hz.front();
  sampling.step_hz = train.baseband_step_hz;
  sampling.count = train.band_bins();
  sampling.frequencies_per_pulse = static_cast<int>(train.frequencies());
  sampling.chirp_rate_hz_s = train.intra_pulse_motion ? train.chirp_rate_hz_s : 0;
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    sampling.pulse_first.push_back(train.code[n] * train.bins_per_hop);
    sampling.pulse_time_s.push_back(start_s + train.time_s[n]);
  }
  return sampling;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "radar/waveform/pulse_train.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

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
    shuffle(label, random);
    for (int& c : code) c = label[c];
    shuffle(code, random);
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

namespace {

// (1/N) sum_{n < N} e^{j n x}
Complex mean_phasor(double x, double count) {
  const double half = std::remainder(x, 2 * kPi) / 2;
  const double denominator = count * std::sin(half);
  const double magnitude = std::abs(half) * count < 1e-8 ? 1 : std::sin(count * half) / denominator;
  return std::polar(1.0, (count - 1) * half) * magnitude;
}

// True for pulses at n T_r, to rounding: sums over them then have a closed form.
bool are_regular(const PulseTrain& train) {
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    if (std::abs(train.time_s[n] - static_cast<double>(n) * train.pri_s) > 1e-9 * train.pri_s) return false;
  }
  return true;
}

// The highest of 2048 exponentially distributed cells against their mean, 10 log10 ln 2048.
constexpr double kLargestOfMapDb = 8.8;

std::string code_name(HopCode code) {
  return code == HopCode::kRandom     ? "random"
         : code == HopCode::kBalanced ? "balanced"
         : code == HopCode::kStepped  ? "stepped"
                                      : "given";
}

// The pedestal extends over half the range cell of one hop on either side; beyond two velocity cells it is outside of
// the main lobe.
std::string pedestal_line(const PulseTrain& train, const RadarSpec& spec) {
  if (train.carriers == 1) return "none, one carrier";
  if (spec.hop_code == HopCode::kFile) return "of the given code: see the map of a point";
  if (spec.hop_code == HopCode::kStepped) {
    return fmt::format("none; each carrier comes every {} pulses: lobes repeat in velocity every {:.4g} m/s",
                       train.carriers, 2 * train.unambiguous_velocity_mps() / train.carriers);
  }
  double largest = 0;
  for (int r = 0; r < 16; ++r) {
    for (int v = 1; v <= 32; ++v) {
      const double range_m = r / 16.0 * kSpeedOfLight / (4 * train.hop_step_hz);
      const double velocity_mps =
          std::max(v / 32.0 * train.unambiguous_velocity_mps(), 2 * train.velocity_resolution_mps());
      largest = std::max(largest, expected_response_power(train, range_m, velocity_mps));
    }
  }
  return fmt::format(
      "{:.1f} dB below a point's peak where largest (mean over codes; single cells up to {:.0f} dB more)",
      -10 * std::log10(largest), kLargestOfMapDb);
}

}  // namespace

double expected_response_power(const PulseTrain& train, double range_offset_m, double velocity_offset_mps) {
  const auto pulses = static_cast<double>(train.pulses());
  std::vector<double> count(train.carriers);
  for (const int c : train.code) ++count[c];
  const auto used = static_cast<double>(std::count_if(count.begin(), count.end(), [](double n) { return n > 0; }));

  // phi_i(n) = -4 pi f_i (dR + dv t_n) / c; m_i its mean phasor over all pulses; c_ij depends on i - j alone.
  const double per_hz = -4 * kPi / kSpeedOfLight;
  const bool regular = are_regular(train);
  const auto mean_at = [&](double frequency_hz) {
    if (regular) {
      return std::polar(1.0, per_hz * frequency_hz * range_offset_m) *
             mean_phasor(per_hz * frequency_hz * velocity_offset_mps * train.pri_s, pulses);
    }
    Complex sum;
    for (const double t : train.time_s)
      sum += std::polar(1.0, per_hz * frequency_hz * (range_offset_m + velocity_offset_mps * t));
    return sum / pulses;
  };
  std::vector<Complex> m(train.carriers);
  std::vector<double> c(train.carriers);
  for (int i = 0; i < train.carriers; ++i) {
    m[i] = mean_at(train.first_carrier_hz + i * train.hop_step_hz);
    c[i] = mean_at(i * train.hop_step_hz).real();
  }

  Complex coherent;
  double scatter = 0;
  for (int i = 0; i < train.carriers; ++i) {
    if (count[i] == 0) continue;
    coherent += m[i];
    if (pulses == 1) continue;
    scatter += (1 / count[i] - 1 / pulses) * pulses / (pulses - 1) * (1 - std::norm(m[i]));
    for (int j = 0; j < i; ++j) {
      if (count[j] > 0) scatter -= 2 * (c[i - j] - std::real(m[i] * std::conj(m[j]))) / (pulses - 1);
    }
  }
  return (std::norm(coherent) + std::max(0.0, scatter)) / (used * used);
}

std::string band_gap_warning(const PulseTrain& train) {
  if (train.carriers < 2 || train.bandwidth_hz >= train.hop_step_hz * (1 - 1e-9)) return "";
  return fmt::format("{:.6g} MHz between the bands of neighbouring carriers: range sidelobes every {:.4g} m",
                     (train.hop_step_hz - train.bandwidth_hz) * 1e-6, kSpeedOfLight / (2 * train.hop_step_hz));
}

std::string figures_of_merit_text(const PulseTrain& train, const RadarSpec& spec) {
  std::vector<int> count(train.carriers);
  for (const int c : train.code) ++count[c];
  const auto [min, max] = std::minmax_element(count.begin(), count.end());
  const double mhz = 1e-6;
  std::string text;
  text += fmt::format(
      "carriers            {} from {:g} GHz by {:g} MHz, {} code, {} to {} pulses each in the first interval\n",
      train.carriers, spec.carrier_ghz, spec.hop_step_mhz, code_name(spec.hop_code), *min, *max);
  text += fmt::format("synthesised band    {:.6g} MHz in {} bins of {:.6g} MHz, {} per pulse\n",
                      train.synthetic_bandwidth_hz() * mhz, train.band_bins(), train.baseband_step_hz * mhz,
                      train.frequencies());
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] == 0) text += fmt::format("hole                no pulse of the first interval uses carrier {}\n", i);
  }
  if (const std::string gaps = band_gap_warning(train); !gaps.empty())
    text += fmt::format("gaps                {}\n", gaps);
  text += fmt::format("range resolution    {:.4g} m, window without wrap {:.4g} m\n", train.range_resolution_m(),
                      train.unambiguous_range_m());
  text += fmt::format("velocity resolution {:.4g} m/s, unambiguous within +-{:.4g} m/s\n",
                      train.velocity_resolution_mps(), train.unambiguous_velocity_mps());
  text += fmt::format("coherent interval   {:.4g} ms, {} pulses{}\n",
                      static_cast<double>(train.pulses()) * train.pri_s * 1e3, train.pulses(),
                      spec.pri_jitter_us > 0 ? fmt::format(", jitter +-{:g} us", spec.pri_jitter_us) : "");
  text += fmt::format("blind range         {:.4g} m, first range ambiguity {:.4g} km\n",
                      kSpeedOfLight * spec.pulse_width_us * 1e-6 / 2, kSpeedOfLight * train.pri_s / 2 * 1e-3);
  text += fmt::format("hop pedestal        {}\n", pedestal_line(train, spec));
  return text;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "radar/waveform/figures_of_merit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"

namespace seaglint {
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

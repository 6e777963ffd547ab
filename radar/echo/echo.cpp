// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/echo.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "radar/echo/sea_clutter.h"
#include "radar/echo/sea_reflectivity.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/text/words.h"

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

// Unscaled clutter echo: in m^2 per frequency for an absolute level, else of mean power 1.
std::vector<Complex> clutter_echo(const PulseTrain& train, const ClutterSpec& clutter, const ClutterScene& scene,
                                  std::uint64_t seed, std::uint64_t index) {
  double power = 1;
  if (is_absolute(clutter.level)) {
    const double sigma0 = std::pow(10, sea_reflectivity_db(clutter, scene, train.band_centre_hz()) / 10);
    const double window_m = train.unambiguous_range_m() / train.grid_refinement;
    power = sigma0 * clutter_patch_area_m2(scene.radar, std::asin(scene.r_hat.z()), window_m) / (4 * kPi);
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

double thermal_noise_m2(const PulseTrain& train, const RadarSpec& radar) {
  constexpr double kBoltzmann = 1.380649e-23;  // J/K, exact in the SI
  const LinkBudgetSpec& budget = radar.link_budget;
  const double wavelength = kSpeedOfLight / train.band_centre_hz();
  const double gain_wavelength = ratio(budget.antenna_gain_db) * wavelength;
  const double range_4 = std::pow(radar.range_km * 1e3, 4);
  const double energy_per_m2 = budget.peak_power_kw * 1e3 * radar.pulse_width_us * 1e-6 * gain_wavelength *
                               gain_wavelength / (16 * kPi * kPi * range_4 * ratio(budget.losses_db));
  const double density = kBoltzmann * budget.reference_temperature_k * ratio(budget.noise_figure_db);
  return static_cast<double>(train.frequencies()) * density / energy_per_m2;
}

void require_power(const FrequencyResponse& target) {
  const double power = mean_power(target.values);
  if (power > 0 && std::isfinite(power)) return;
  throw InputError(fmt::format(
      "the target's echo has no power (mean {} m^2): nothing faces the radar, or the polarisation is not returned",
      power));
}

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
  if ((clutter.enabled && clutter.level == ClutterLevel::kScr) || clutter.noise_level == NoiseLevel::kSnr)
    require_power(response);

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

// Refinements of a frequency grid, odd, so that pulse and range window fit into one period of the samples.
struct Refinements {
  int lowest = 1;
  int highest = 1;
};

Refinements refinements_of(const PulseTrain& train, double pulse_s) {
  const double needed_s = pulse_s + 2 * train.unambiguous_range_m() / kSpeedOfLight;
  const int least = static_cast<int>(std::ceil(needed_s * train.baseband_step_hz));
  return {least + (least + 1) % 2, 4 * least};
}

// The lowest refinement of which the sampling rate is a whole number of steps; 0 without one.
int fitting_refinement(double sampling_hz, double step_hz, const Refinements& range) {
  for (int refinement = range.lowest; refinement <= range.highest; refinement += 2) {
    if (whole_ratio(sampling_hz, step_hz / refinement) != 0) return refinement;
  }
  return 0;
}

// The nearest rate that fits, MHz, above (direction 1) or below (-1) one that does not. One of at most six digits,
// which a scenario can state, precedes nearer ones: of each refinement the first within kSteps steps. 0 without any.
double nearest_rate_mhz(double sampling_mhz, double step_hz, const Refinements& range, int direction) {
  constexpr int kSteps = 20, kRefinements = 1000;  // of thousands the first have the longest steps
  double nearest = 0, nearest_short = 0;
  const auto take = [&](double& best, double rate_mhz) {
    const bool is_nearer = best == 0 || direction * (best - rate_mhz) > 0;
    if (rate_mhz > 0 && direction * (rate_mhz - sampling_mhz) > 0 && is_nearer) best = rate_mhz;
  };
  const int last = std::min(range.highest, range.lowest + kRefinements);
  for (int refinement = range.lowest; refinement <= last; refinement += 2) {
    const double step_mhz = step_hz * 1e-6 / refinement;
    const double below = std::floor(sampling_mhz / step_mhz);
    for (int k = 0; k < kSteps; ++k) {
      const double rate_mhz = (direction > 0 ? below + 1 + k : below - k) * step_mhz;
      if (k == 0) take(nearest, rate_mhz);
      const double rounded = parse_number(fmt::format("{:.6g}", rate_mhz)).value_or(0);
      if (whole_ratio(rounded, step_mhz) == 0) continue;
      take(nearest_short, rounded);
      break;
    }
  }
  return nearest_short != 0 ? nearest_short : nearest;
}

[[noreturn]] void refuse_rate(const RadarSpec& radar, double step_hz, const Refinements& range) {
  std::vector<std::string> nearest;
  for (const int direction : {-1, 1}) {
    const double rate_mhz = nearest_rate_mhz(radar.sampling_mhz, step_hz, range, direction);
    if (rate_mhz > 0 && rate_mhz >= radar.bandwidth_mhz) nearest.push_back(fmt::format("{}", rate_mhz));
  }
  throw InputError(
      fmt::format("radar.sampling_mhz: value {}: must be a multiple of a frequency step below {:.6g} MHz for an echo "
                  "in samples{}{}",
                  radar.sampling_mhz, step_hz * 1e-6 / range.lowest,
                  nearest.empty() ? "" : "; the nearest: ", fmt::join(nearest, " and ")));
}

}  // namespace

PulseTrain train_for_samples(const PulseTrain& train, const RadarSpec& radar) {
  const double sampling_hz = radar.sampling_mhz * 1e6, pulse_s = radar.pulse_width_us * 1e-6;
  const Refinements range = refinements_of(train, pulse_s);
  const int refinement = fitting_refinement(sampling_hz, train.baseband_step_hz, range);
  if (refinement == 0) refuse_rate(radar, train.baseband_step_hz, range);
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

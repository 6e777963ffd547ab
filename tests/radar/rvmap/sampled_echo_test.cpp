// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>
#include <utility>

#include "radar/echo/echo.h"
#include "radar/echo/sea_clutter.h"
#include "radar/rvmap/rv_map.h"
#include "radar/waveform/pulse_train.h"
#include "sim/canonical/point_response.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "tests/measured.h"
#include "tests/refusal.h"
#include "tests/relative_difference.h"

namespace seaglint {
namespace {

// Time-domain echo: the same maps as in the frequency domain, and its difference from an echo formed independently by
// delaying the ideal chirp.

const std::vector<PointSpec> kPoints{{{-31.5, 0, 0}, 1, {3, 0, 0}},  // farther, approaching
                                     {{4.2, 0, 0}, 0.6, {-1.5, 0, 0}},
                                     {{44, 0, 0}, 0.8, {0, 0, 0}}};

RadarSpec radar_with(bool intra_pulse_motion) {
  RadarSpec radar;
  radar.pulses = 64;
  radar.intra_pulse_motion = intra_pulse_motion;
  return radar;
}

std::vector<Complex> echo_in_frequency(const PulseTrain& train) {
  ClutterSpec off;
  off.enabled = false;
  return synthesise_echo(train, point_response(kPoints, Vec3(1, 0, 0), interval_sampling(train, 0)), off, 1, 1).target;
}

// Every point's echo is the ideal rectangular chirp, delayed. With motion inside the pulse the delay is that of the
// moment when the sample's wave reached the point, t - R/c; without it, that of the pulse's middle.
SampledEcho echo_by_delay(const PulseTrain& train, const RadarSpec& radar, const SampledEcho& like) {
  SampledEcho sampled = like;
  const double pulse_s = radar.pulse_width_us * 1e-6, mu = train.chirp_rate_hz_s;
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    for (std::size_t k = 0; k < like.samples(); ++k) {
      const double t = like.time_s[k];
      Complex sum;
      for (const PointSpec& point : kPoints) {
        double met_s = train.time_s[n], delay_s = 0;
        for (int iteration = 0; iteration < 4; ++iteration) {  // c is 1e8 times faster than the points
          const double range_m = -(point.position_m[0] + point.velocity_mps[0] * met_s);
          delay_s = 2 * range_m / kSpeedOfLight;
          if (radar.intra_pulse_motion) met_s = train.time_s[n] + t - delay_s / 2;
        }
        const double u = t - delay_s;
        if (std::abs(u) >= pulse_s / 2) continue;
        sum += point.amplitude_m * std::polar(1.0, kPi * mu * u * u - 2 * kPi * train.carrier_hz[n] * delay_s);
      }
      sampled.values[n * like.samples() + k] = sum;
    }
  }
  return sampled;
}

double largest_difference(const RvMap& a, const RvMap& b) {
  double difference = 0, peak = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    difference = std::max(difference, std::abs(a.values[i] - b.values[i]));
    peak = std::max(peak, std::abs(a.values[i]));
  }
  return difference / peak;
}

TEST(SampledEcho, ContainsTheWholePulseAndTheWindow) {
  const RadarSpec radar = radar_with(false);
  const PulseTrain train = make_pulse_train(radar, 239.8, 1, 2), fine = train_for_samples(train, radar);
  const SampledEcho sampled = sample_echo(echo_in_frequency(fine), fine, 50e6);
  EXPECT_EQ(fine.grid_refinement, 25);
  EXPECT_EQ(sampled.samples(), 2000u);  // 36 us of pulse and 1.6 us of window fit into 40 us
  for (std::size_t b = 0; b < train.frequencies(); ++b)
    EXPECT_NEAR(fine.baseband_hz[25 * b + 12], train.baseband_hz[b], 1e-6);
  EXPECT_EQ(sampled.time_s.size() * 64, sampled.values.size());
}

// Each rate of the message is a whole number of the steps of one odd refinement, and is accepted.
TEST(SampledEcho, WithARateThatDoesNotFitIsRefusedWithTheNearestRatesThatDo) {
  for (const double wrong_mhz : {50.013, 51.2349, 40.001, 25.000001, 66.66}) {
    for (const double hop_step_mhz : {25.0, 10.0 / 3, 7.0}) {
      RadarSpec radar = radar_with(false);
      radar.hop_step_mhz = hop_step_mhz;
      radar.sampling_mhz = wrong_mhz;
      const PulseTrain train = make_pulse_train(radar, 239.8, 1, 2);
      const std::string message = refusal_of([&] { train_for_samples(train, radar); });
      const std::string mark = "; the nearest: ";
      const std::size_t at = message.find(mark);
      ASSERT_NE(at, std::string::npos) << message << wrong_mhz << " " << hop_step_mhz;
      std::istringstream rates(message.substr(at + mark.size()));
      double below = 0, above = 0;
      std::string word;
      rates >> below;
      if (below < wrong_mhz) {
        rates >> word >> above;
        EXPECT_EQ(word, "and");
      } else {  // that below is less than the bandwidth
        std::swap(below, above);
      }
      for (const double rate : {below, above}) {
        if (rate == 0) continue;
        radar.sampling_mhz = rate;
        EXPECT_NO_THROW(train_for_samples(train, radar)) << message;
        EXPECT_NEAR(rate, wrong_mhz, train.baseband_step_hz * 1e-6) << message;
      }
      EXPECT_LT(below, wrong_mhz);
      EXPECT_GT(above, wrong_mhz);
    }
  }
}

TEST(SampledEcho, OfAPointAtRestIsTheChirpTimesItsAmplitude) {
  const RadarSpec radar = radar_with(false);
  const PulseTrain fine = train_for_samples(make_pulse_train(radar, 239.8, 1, 2), radar);
  std::vector<Complex> echo;
  for (std::size_t n = 0; n < fine.pulses(); ++n)
    for (const Complex& p : fine.chirp_spectrum) echo.push_back(3.0 * p);
  const SampledEcho sampled = sample_echo(echo, fine, 50e6);
  const double mu = fine.chirp_rate_hz_s, half_pulse_s = 18e-6;
  for (std::size_t k = 0; k < sampled.samples(); ++k) {
    const double t = sampled.time_s[k];
    const Complex chirp = std::abs(t) < half_pulse_s ? std::polar(3.0, kPi * mu * t * t) : 0.0;
    // The band's limit rounds both ends of the pulse: Fresnel ripples 1 / (pi sqrt(2) u) at u = |t - end| sqrt(mu) from
    // each, twice that as bound, and 2 % for what the sampled chirp folds into the band.
    const double u = std::abs(std::abs(t) - half_pulse_s) * std::sqrt(mu);
    if (u < 1) continue;
    EXPECT_NEAR(std::abs(sampled.values[k] - chirp), 0, 3 * (4 / (kPi * std::sqrt(2.0) * u) + 0.02)) << t;
  }
}

// 40 and 33 frequencies, even and odd; a period of the map of 80, 66 and 79.2 samples.
TEST(SampledEcho, HasTheSameMapAsTheFrequencyDomain) {
  for (const bool intra_pulse_motion : {false, true}) {
    for (const auto& [window_m, sampling_mhz] : {std::pair{239.8, 50.0}, {192.0, 50.0}, {192.0, 60.0}}) {
      RadarSpec radar = radar_with(intra_pulse_motion);
      radar.sampling_mhz = sampling_mhz;
      const PulseTrain train = make_pulse_train(radar, window_m, 1, 2), fine = train_for_samples(train, radar);
      const SampledEcho sampled = sample_echo(echo_in_frequency(fine), fine, sampling_mhz * 1e6);
      const double difference =
          largest_difference(form_rv_map(echo_in_frequency(train), train, {}, intra_pulse_motion),
                             form_rv_map(spectrum_of(sampled, train), train, {}, intra_pulse_motion));
      std::printf("intra-pulse motion %d, %zu frequencies, %g MHz: maps differ by %.1e of the peak\n",
                  intra_pulse_motion, train.frequencies(), sampling_mhz, difference);
      EXPECT_LT(difference, 1e-6);
    }
  }
}

// The sampled rectangular chirp has power beyond |f| = fs/2 that folds into the band, about 1.5 % of the amplitude for
// a time-bandwidth product of 900; the delayed chirp folds differently than P(f) for delays that are no whole samples.
TEST(SampledEcho, DiffersFromAChirpDelayedInTimeByItsAliasingOnly) {
  double worst = 0;
  for (const bool intra_pulse_motion : {false, true}) {
    const RadarSpec radar = radar_with(intra_pulse_motion);
    const PulseTrain train = make_pulse_train(radar, 239.8, 1, 2), fine = train_for_samples(train, radar);
    const std::vector<Complex> in_frequency = echo_in_frequency(train);
    const SampledEcho delayed = echo_by_delay(train, radar, sample_echo(echo_in_frequency(fine), fine, 50e6));
    const std::vector<Complex> in_time = spectrum_of(delayed, train);
    const double difference = relative_difference(in_time, in_frequency);
    const double in_map = largest_difference(form_rv_map(in_frequency, train, {}, intra_pulse_motion),
                                             form_rv_map(in_time, train, {}, intra_pulse_motion));
    std::printf("intra-pulse motion %d: in band %.2f %% rms, in the map %.1e of the peak\n", intra_pulse_motion,
                100 * difference, in_map);
    EXPECT_LT(difference, 0.02);
    EXPECT_LT(in_map, 0.005);
    // An error of the sign of time, range or Doppler, or of f/mu, must be detected: the wrong setting gives a different
    // map.
    const RadarSpec other = radar_with(!intra_pulse_motion);
    const std::vector<Complex> wrong = echo_in_frequency(make_pulse_train(other, 239.8, 1, 2));
    EXPECT_GT(relative_difference(in_time, wrong), 1.5 * difference);
    worst = std::max(worst, difference);
  }
  record_figure(100 * worst, 2, "sampled_echo_delay_percent");
}

TEST(SampledEcho, HasTheSameClutter) {
  const RadarSpec radar = radar_with(false);
  const PulseTrain train = make_pulse_train(radar, 100, 1, 2), fine = train_for_samples(train, radar);
  const std::vector<Complex> coarse = clutter_response(train, {}, {}, 3, 4),
                             finer = clutter_response(fine, {}, {}, 3, 4);
  const std::size_t m = static_cast<std::size_t>(fine.grid_refinement);
  double largest = 0;
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    for (std::size_t b = 0; b < train.frequencies(); ++b) {
      largest = std::max(
          largest, std::abs(coarse[n * train.frequencies() + b] - finer[n * fine.frequencies() + m * b + (m - 1) / 2]));
    }
  }
  EXPECT_LT(largest, 1e-12);
}

TEST(SampledEcho, RefusesASamplingThatFitsNoGrid) {
  RadarSpec radar = radar_with(false);
  radar.sampling_mhz = 50.0 * std::sqrt(1.1);
  const PulseTrain train = make_pulse_train(radar, 239.8, 1, 2);
  EXPECT_THROW(train_for_samples(train, radar), InputError);
}

// The random-hop pedestal of one point against its closed form, by averaging maps over many codes.

constexpr double kPedestalTolerance = 0.5;  // dB: 3.6 standard errors of the mean of 1,000 exponential values
constexpr double kListRounding = 0.2;  // dB: the list gives one figure for both kinds of code, which differ by 0.13 dB
constexpr int kCodes = 1000;

struct Offset {
  double range_m, velocity_mps, balanced_db, random_db;
};
// Random hopping leaves a pedestal (radar/waveform/README.md).
constexpr Offset kListed[] = {
    {1.5, 1.757, -24.1, -24.1}, {0, 1, -34.3, -33.1}, {0, 5, -31.4, -30.7}, {2, 0, -18.09, -18.09}};

// Mean |RV|^2 at one offset from the point's peak over codes, and the mean of its closed form, from a map of one cell
// row.
struct Means {
  double measured = 0, expected = 0;
};
Means mean_response(const RadarSpec& radar, const Offset& offset, double window_m) {
  Means means;
  for (int i = 0; i < kCodes; ++i) {
    const PulseTrain train = make_pulse_train(radar, window_m, 77, i);
    // In the map's cell at 0, 0 the point is at minus the offset.
    const PointSpec point{{offset.range_m, 0, 0}, 1, {offset.velocity_mps, 0, 0}};
    ClutterSpec clutter;
    clutter.enabled = false;
    const Echo echo =
        synthesise_echo(train, point_response({&point, 1}, Vec3(1, 0, 0), interval_sampling(train, 0)), clutter, 1, 1);
    MapSpec spec;
    spec.range_taper = Taper::kNone;
    spec.range_span_m = spec.velocity_span_mps = 1e-3;
    const RvMap map = form_rv_map(echo.target, train, spec, false);
    EXPECT_EQ(map.values.size(), 1u);
    means.measured += std::norm(map.values[0]) / kCodes;
    means.expected += expected_response_power(train, offset.range_m, offset.velocity_mps) / kCodes;
  }
  return means;
}

double decibel(double power) { return 10 * std::log10(power); }

// One frequency per pulse, for which the closed form is exact.
TEST(Pedestal, OfOneFrequencyPerPulseIsTheClosedForm) {
  for (const HopCode code : {HopCode::kBalanced, HopCode::kRandom}) {
    for (const Offset& offset : kListed) {
      RadarSpec radar;
      radar.hop_code = code;
      const Means means = mean_response(radar, offset, 5.9);
      const double listed = code == HopCode::kBalanced ? offset.balanced_db : offset.random_db;
      std::printf("%s dR %.1f m dv %.3f m/s: measured %.2f, closed form %.2f, listed %.2f dB\n",
                  code == HopCode::kBalanced ? "balanced" : "random  ", offset.range_m, offset.velocity_mps,
                  decibel(means.measured), decibel(means.expected), listed);
      EXPECT_NEAR(decibel(means.measured), decibel(means.expected), kPedestalTolerance);
      EXPECT_NEAR(decibel(means.measured), listed, kPedestalTolerance);
      EXPECT_NEAR(decibel(means.expected), listed, kListRounding);
    }
  }
}

// 1,000 codes leave a standard error of 0.14 dB in a cell's mean, 40,000 leave 0.02 dB: the map's estimator, mean over
// each carrier's pulses, then over the carriers that were used, written out.
TEST(Pedestal, OfFortyThousandCodesIsTheClosedFormToATenthOfADecibel) {
  constexpr int kManyCodes = 40000;
  double worst_db = 0;
  for (const HopCode code : {HopCode::kBalanced, HopCode::kRandom}) {
    for (const Offset& offset : kListed) {
      RadarSpec radar;
      radar.hop_code = code;
      PulseTrain train = make_pulse_train(radar, 5.9, 77, 0);
      // e^{j phi} of every pulse on every carrier, and the closed form of one set of counts, which random codes change.
      std::vector<Complex> phasor(256 * 8);
      for (int n = 0; n < 256; ++n) {
        for (int i = 0; i < 8; ++i) {
          const double range = offset.range_m + offset.velocity_mps * train.time_s[n];
          phasor[8 * n + i] = std::polar(1.0, -4 * kPi * (16e9 + 25e6 * i) * range / kSpeedOfLight);
        }
      }
      double measured = 0, expected = 0;
      for (int repeat = 0; repeat < kManyCodes; ++repeat) {
        train.code = hop_code(code, 256, 8, 78, repeat);
        std::array<Complex, 8> sum{};
        std::array<int, 8> count{};
        for (int n = 0; n < 256; ++n) {
          sum[train.code[n]] += phasor[8 * n + train.code[n]];
          ++count[train.code[n]];
        }
        Complex mean;
        for (int i = 0; i < 8; ++i) mean += sum[i] / static_cast<double>(count[i]);  // 256 pulses leave none empty
        measured += std::norm(mean / 8.0) / kManyCodes;
        if (repeat % 100 == 0)
          expected += expected_response_power(train, offset.range_m, offset.velocity_mps) * 100 / kManyCodes;
      }
      std::printf("%s dR %.1f m dv %.3f m/s: %d codes %.3f, closed form %.3f dB\n",
                  code == HopCode::kBalanced ? "balanced" : "random  ", offset.range_m, offset.velocity_mps, kManyCodes,
                  decibel(measured), decibel(expected));
      EXPECT_NEAR(decibel(measured), decibel(expected), 0.1);
      worst_db = std::max(worst_db, std::abs(decibel(measured) - decibel(expected)));
    }
  }
  record_figure(worst_db, 3, "pedestal_db");
}

TEST(Pedestal, OfPulsesThatJitterIsTheClosedFormAtTheirTimes) {
  RadarSpec radar;
  radar.hop_code = HopCode::kBalanced;
  radar.pri_jitter_us = 100;
  for (const Offset& offset : {Offset{1.5, 1.757, 0, 0}, Offset{0, 5, 0, 0}}) {
    const Means means = mean_response(radar, offset, 5.9);
    std::printf("jitter   dR %.1f m dv %.3f m/s: measured %.2f, closed form %.2f dB\n", offset.range_m,
                offset.velocity_mps, decibel(means.measured), decibel(means.expected));
    EXPECT_NEAR(decibel(means.measured), decibel(means.expected), kPedestalTolerance);
  }
}

// The whole chirp: the pedestal is shaped in range by the chirp's own resolution, sinc^2(2 B dR / c).
TEST(Pedestal, OfTheWholeChirpFollowsTheRangeCellOfOnePulse) {
  for (const Offset& offset : {Offset{1.5, 1.757, 0, 0}, Offset{0, 5, 0, 0}, Offset{4, 3.3, 0, 0}}) {
    RadarSpec radar;
    radar.hop_code = HopCode::kBalanced;
    const Means means = mean_response(radar, offset, 59);
    // The range offset grows by dv t during the interval.
    double shape = 0;
    for (int n = 0; n < 256; ++n) {
      const double x = kPi * 2 * 25e6 * (offset.range_m + offset.velocity_mps * n * 250e-6) / kSpeedOfLight;
      shape += (x == 0 ? 1 : std::pow(std::sin(x) / x, 2)) / 256;
    }
    std::printf("whole chirp, dR %.1f m dv %.3f m/s: measured %.2f, closed form with range cell %.2f dB\n",
                offset.range_m, offset.velocity_mps, decibel(means.measured), decibel(means.expected * shape));
    EXPECT_NEAR(decibel(means.measured), decibel(means.expected * shape), kPedestalTolerance);
  }
}

TEST(Pedestal, IsAbsentAtTheVelocityOfThePoint) {
  const PulseTrain train = make_pulse_train({}, 59, 77, 1);
  const PointSpec point{{0, 0, 0}, 1, {0, 0, 0}};
  ClutterSpec clutter;
  clutter.enabled = false;
  const Echo echo =
      synthesise_echo(train, point_response({&point, 1}, Vec3(1, 0, 0), interval_sampling(train, 0)), clutter, 1, 1);
  MapSpec spec;
  spec.range_taper = Taper::kNone;
  spec.velocity_span_mps = 1e-3;
  const RvMap map = form_rv_map(echo.target, train, spec, false);
  for (std::size_t r = 0; r < map.columns(); ++r) {
    const double expected = map.range_m[r] == 0 ? 1 : 0;   // the Dirichlet kernel at its zeros
    EXPECT_NEAR(std::abs(map.values[r]), expected, 1e-6);  // -120 dB
  }
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Time-domain echo: the same maps as in the frequency domain, and its difference from an echo formed independently by
// delaying the ideal chirp.
#include "radar/echo/echo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>
#include <utility>

#include "radar/echo/sea_clutter.h"
#include "radar/rvmap/rv_map.h"
#include "sim/canonical/point_response.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "tests/measured.h"

namespace seaglint {
namespace {

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

double relative_difference(const std::vector<Complex>& a, const std::vector<Complex>& b) {
  double difference = 0, power = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference += std::norm(a[i] - b[i]), power += std::norm(a[i]);
  return std::sqrt(difference / power);
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
      std::string message = "accepted";
      try {
        train_for_samples(train, radar);
      } catch (const InputError& error) {
        message = error.what();
      }
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
    const double difference = relative_difference(in_frequency, in_time);
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
    EXPECT_GT(relative_difference(wrong, in_time), 1.5 * difference);
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

}  // namespace
}  // namespace seaglint

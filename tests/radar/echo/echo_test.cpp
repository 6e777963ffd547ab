// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/echo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "radar/echo/sea_clutter.h"
#include "sim/canonical/point_response.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

constexpr double kShipWindow = 239.8;

FrequencyResponse one_point(const PulseTrain& train, double amplitude = 1) {
  const PointSpec point{{7, 0, 0}, amplitude, {2, 0, 0}};
  return point_response({&point, 1}, Vec3(1, 0, 0), interval_sampling(train, 0));
}

// An interval with a texture of its own.
ClutterScene interval(std::uint64_t index) {
  ClutterScene scene;
  scene.texture_key = index;
  return scene;
}

// Mean ratios of echo powers over intervals need many small intervals: range cells of one carrier.
RadarSpec small_radar() {
  RadarSpec radar;
  radar.pulses = 64;
  return radar;
}

TEST(Echo, IsTheTransmitSpectrumTimesTheResponse) {
  const PulseTrain train = make_pulse_train({}, kShipWindow, 1, 2);
  const FrequencyResponse response = one_point(train, 3);
  ClutterSpec off;
  off.enabled = false;
  const Echo echo = synthesise_echo(train, response, off, 1, 1);
  EXPECT_TRUE(echo.clutter.empty());
  EXPECT_EQ(echo.pulses, 256);
  EXPECT_EQ(echo.frequencies, 40);
  for (std::size_t i = 0; i < echo.target.size(); ++i)
    EXPECT_EQ(echo.target[i], train.chirp_spectrum[i % 40] * response.values[i]);
  EXPECT_EQ(echo.total(), echo.target);
}

TEST(Echo, HasThePerPulseRatioExactly) {
  const PulseTrain train = make_pulse_train({}, kShipWindow, 1, 2);
  for (const double scr_db : {-10.0, 20.0, 60.0}) {
    ClutterSpec clutter;
    clutter.scr_db = scr_db;
    const Echo echo = synthesise_echo(train, one_point(train, 0.01), clutter, 1, 1);
    EXPECT_NEAR(10 * std::log10(mean_power(echo.target) / mean_power(echo.clutter)), scr_db, 1e-9);
  }
}

TEST(Echo, OfNoTargetIsRefusedWhereALevelIsRelativeToIt) {
  const PulseTrain train = make_pulse_train({}, kShipWindow, 1, 2);
  FrequencyResponse nothing = one_point(train);
  for (Complex& value : nothing.values) value = 0;
  ClutterSpec spec;
  EXPECT_THROW(synthesise_echo(train, nothing, spec, 1, 1), InputError);
  spec.level = ClutterLevel::kNrl;
  ClutterScene scene;
  scene.r_hat = Vec3(std::cos(0.03), 0, std::sin(0.03));
  scene.significant_wave_height_m = 1;
  const Echo echo = synthesise_echo(train, nothing, spec, 1, 1, scene);
  EXPECT_EQ(mean_power(echo.target), 0);
  EXPECT_GT(mean_power(echo.clutter), 0);
  EXPECT_EQ(echo.clutter, synthesise_echo(train, one_point(train), spec, 1, 1, scene).clutter);
  spec.noise_level = NoiseLevel::kSnr;
  EXPECT_THROW(synthesise_echo(train, nothing, spec, 1, 1), InputError);
}

TEST(Echo, RepeatsForOneKeyAndDiffersForAnother) {
  const PulseTrain train = make_pulse_train(small_radar(), kShipWindow, 1, 2);
  const FrequencyResponse response = one_point(train);
  const Echo a = synthesise_echo(train, response, {}, 1, 1);
  EXPECT_EQ(a.clutter, synthesise_echo(train, response, {}, 1, 1).clutter);
  EXPECT_NE(a.clutter, synthesise_echo(train, response, {}, 1, 2).clutter);
  EXPECT_NE(a.clutter, synthesise_echo(train, response, {}, 2, 1).clutter);
}

TEST(Clutter, HasMeanPowerOneAtEveryShapeAndSpread) {
  const PulseTrain train = make_pulse_train(small_radar(), 100, 1, 2);
  for (const double spread : {0.0, 0.5, 20.0}) {
    ClutterSpec spec;
    spec.texture_shape = 5;
    spec.doppler_spread_mps = spread;
    double mean = 0, square = 0;
    const int intervals = 400;
    for (int i = 0; i < intervals; ++i) {
      const double power = mean_power(clutter_response(train, spec, interval(i), 3, i));
      mean += power / intervals;
      square += power * power / intervals;
    }
    const double deviation = std::sqrt((square - mean * mean) / intervals);
    EXPECT_NEAR(mean, 1, 4 * deviation) << spread;  // four standard errors
    EXPECT_LT(deviation, 0.02);
  }
}

// One range profile over the synthesised band at one moment: a stepped burst with the sea at rest.
std::vector<Complex> range_profile(const PulseTrain& train, const std::vector<Complex>& response) {
  const std::size_t bins = train.band_bins();
  std::vector<Complex> profile;
  for (std::size_t r = 0; r < bins; ++r) {
    Complex sum;
    for (std::size_t n = 0; n < train.pulses(); ++n) {
      for (std::size_t b = 0; b < train.frequencies(); ++b) {
        const std::size_t k = train.code[n] * train.bins_per_hop + b;
        const double taper = 0.5 - 0.5 * std::cos(2 * kPi * (static_cast<double>(k) + 0.5) / static_cast<double>(bins));
        sum += taper * response[n * train.frequencies() + b] *
               std::polar(1.0, 2 * kPi * static_cast<double>(k * r % bins) / static_cast<double>(bins));
      }
    }
    profile.push_back(sum);
  }
  return profile;
}

TEST(Clutter, IsKDistributedInRangeCells) {
  RadarSpec radar;
  radar.pulses = 8;
  radar.hop_code = HopCode::kStepped;
  const PulseTrain train = make_pulse_train(radar, 100, 1, 2);
  for (const double shape : {0.5, 2.0, 100.0}) {
    ClutterSpec spec;
    spec.texture_shape = shape;
    spec.doppler_spread_mps = 0;
    // <I^2>/<I>^2 = 2 (1 + 1/shape); batches give the standard error.
    std::vector<double> ratios;
    for (int batch = 0; batch < 20; ++batch) {
      double first = 0, second = 0, count = 0;
      for (int i = 0; i < 20; ++i) {
        for (const Complex& value :
             range_profile(train, clutter_response(train, spec, interval(20 * batch + i), 3, 20 * batch + i))) {
          const double intensity = std::norm(value);
          first += intensity;
          second += intensity * intensity;
          ++count;
        }
      }
      ratios.push_back(second / count / std::pow(first / count, 2));
    }
    double mean = 0, square = 0;
    for (const double r : ratios) mean += r / 20, square += r * r / 20;
    const double error = std::sqrt((square - mean * mean) / 19), expected = 2 * (1 + 1 / shape);
    std::printf("shape %.1f: <I^2>/<I>^2 = %.3f +- %.3f, law %.3f\n", shape, mean, error, expected);
    // Texture varies a little inside a cell (3 % of its variance), and a batch's mean power is uncertain (bias of the
    // ratio).
    EXPECT_NEAR(mean, expected, 4 * error + 0.05 * (expected - 2));
  }
}

TEST(Clutter, IsTheSameSeaAtEveryCarrier) {
  // Two pulses on neighbouring carriers, the sea at rest: the overlap of two 60 MHz chirps sees identical values.
  RadarSpec radar;
  radar.pulses = 2;
  radar.carrier_count = 2;
  radar.hop_code = HopCode::kStepped;
  radar.bandwidth_mhz = 50;
  radar.sampling_mhz = 100;
  const PulseTrain train = make_pulse_train(radar, 100, 1, 2);
  ClutterSpec spec;
  spec.doppler_spread_mps = 0;
  const std::vector<Complex> response = clutter_response(train, spec, {}, 3, 4);
  const std::size_t hop = train.bins_per_hop, bins = train.frequencies();
  for (std::size_t b = hop; b < bins; ++b)
    EXPECT_NEAR(std::abs(response[b] - response[bins + b - hop]), 0, 1e-5);  // 1e-6 of drift in a coherent interval
}

TEST(Clutter, DecorrelatesWithinTheChirpByItsRangeWindow) {
  // Scatterers fill the window c / (2 step) evenly: neighbouring bins are uncorrelated, <H(f) H*(f')> = 0.
  const PulseTrain train = make_pulse_train(small_radar(), 100, 1, 2);
  ClutterSpec spec;
  spec.texture_shape = 1000;
  Complex sum;
  double power = 0;
  const int intervals = 300;
  for (int i = 0; i < intervals; ++i) {
    const std::vector<Complex> response = clutter_response(train, spec, interval(i), 3, i);
    for (std::size_t b = 1; b < train.frequencies(); ++b) {
      sum += response[b] * std::conj(response[b - 1]);
      power += std::norm(response[b]);
    }
  }
  const double samples = intervals * static_cast<double>(train.frequencies() - 1);
  EXPECT_LT(std::abs(sum) / power, 4 / std::sqrt(samples));
}

TEST(Clutter, HasTheSpecifiedDopplerMeanAndSpread) {
  RadarSpec radar;
  radar.carrier_count = 1;
  radar.pulses = 64;
  const PulseTrain train = make_pulse_train(radar, 100, 1, 2);
  ClutterSpec spec;
  spec.doppler_mean_mps = 1.2;
  spec.doppler_spread_mps = 0.6;
  // Correlation over one and four pulses: rho = e^{-(4 pi s tau / lambda)^2 / 2} e^{-j 4 pi v tau / lambda}.
  const double wavelength = kSpeedOfLight / train.band_centre_hz();
  for (const int lag : {1, 4}) {
    Complex sum;
    double power = 0;
    for (int i = 0; i < 200; ++i) {
      const std::vector<Complex> response = clutter_response(train, spec, interval(i), 3, i);
      const std::size_t bins = train.frequencies();
      for (std::size_t n = 0; n + lag < train.pulses(); ++n) {
        for (std::size_t b = 0; b < bins; ++b) {
          sum += response[(n + lag) * bins + b] * std::conj(response[n * bins + b]);
          power += 0.5 * (std::norm(response[(n + lag) * bins + b]) + std::norm(response[n * bins + b]));
        }
      }
    }
    const double tau = lag * train.pri_s, spread = 4 * kPi * *spec.doppler_spread_mps * tau / wavelength;
    const Complex expected =
        std::polar(std::exp(-spread * spread / 2), -4 * kPi * spec.doppler_mean_mps * tau / wavelength);
    std::printf("lag %d: %.4f %+.4fj, law %.4f %+.4fj\n", lag, (sum / power).real(), (sum / power).imag(),
                expected.real(), expected.imag());
    // About 200 x 17 bins x 5 independent moments.
    EXPECT_NEAR(std::abs(sum / power - expected), 0, 4 / std::sqrt(17000.0));
  }
}

TEST(Clutter, ReceiverNoiseIsWhiteAndHasItsLevel) {
  const PulseTrain train = make_pulse_train({}, kShipWindow, 1, 2);
  ClutterSpec clutter;
  const std::vector<Complex> noise = synthesise_echo(train, one_point(train), clutter, 1, 1).noise;
  const std::size_t bins = train.frequencies();
  Complex along_frequency, along_pulses;
  double power = 0;
  for (std::size_t i = bins; i < noise.size(); ++i) {
    along_frequency += noise[i] * std::conj(noise[i - 1]);
    along_pulses += noise[i] * std::conj(noise[i - bins]);
    power += std::norm(noise[i]);
  }
  const double bound = 4 / std::sqrt(static_cast<double>(noise.size()));
  EXPECT_LT(std::abs(along_frequency) / power, bound);
  EXPECT_LT(std::abs(along_pulses) / power, bound);
  double edge = 0;  // white although |P|^2 falls to a quarter at the band's edge
  for (std::size_t n = 0; n < train.pulses(); ++n)
    edge += std::norm(noise[n * bins]) / static_cast<double>(train.pulses());
  EXPECT_NEAR(edge / mean_power(noise), 1, 4 / std::sqrt(256.0));
}

}  // namespace
}  // namespace seaglint

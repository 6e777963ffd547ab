// SPDX-License-Identifier: BSD-3-Clause
// Simulated clutter beside measured clutter: 131 s of I/Q of a range cell of 30 m at 9.39 GHz and 1 kHz, its statistics
// by the definitions of tests/reference/sea_clutter/SOURCE.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "radar/echo/sea_clutter.h"
#include "sim/core/numbers/constants.h"
#include "sim/scenario/scenario.h"
#include "sim/sea/realisation.h"
#include "tests/measured.h"

namespace seaglint {
namespace {

constexpr double kPri_s = 1e-3;
constexpr std::size_t kBlock = 128;  // pulses

double mean(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}

double covariance(const std::vector<double>& x, const std::vector<double>& y, std::size_t lag = 0) {
  const double of_x = mean(x), of_y = mean(y);
  double sum = 0;
  for (std::size_t i = 0; i + lag < x.size(); ++i) sum += (x[i + lag] - of_x) * (y[i] - of_y);
  return sum / static_cast<double>(x.size());
}

double mean_product(const std::vector<double>& x, const std::vector<double>& y) {
  return covariance(x, y) + mean(x) * mean(y);
}

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
  return covariance(x, y) / std::sqrt(covariance(x, x) * covariance(y, y));
}

// Mean of the power n of intensity over that of a K distribution with the second moment of these samples.
double moment_over_k(const std::vector<Complex>& samples, int n) {
  double power = 0, second = 0, high = 0;
  for (const Complex& z : samples) power += std::norm(z);
  power /= static_cast<double>(samples.size());
  for (const Complex& z : samples) {
    const double intensity = std::norm(z) / power;
    second += intensity * intensity;
    high += std::pow(intensity, n);
  }
  second /= static_cast<double>(samples.size());
  const double shape = 2 / std::max(second - 2, 1e-3);
  const double of_k =
      std::exp(std::lgamma(n + 1.0) + std::lgamma(shape + n) - std::lgamma(shape) - n * std::log(shape));
  return high / static_cast<double>(samples.size()) / of_k;
}

// Statistics in the order of kNames.
constexpr std::array kNames{"second moment",
                            "third moment over K's",
                            "fourth moment over K's",
                            "power and velocity, correlation",
                            "log power and width, correlation",
                            "velocity weighted with power (m/s)",
                            "velocity, deviation (m/s)",
                            "width, mean (m/s)",
                            "width, deviation over mean",
                            "power over 0.5 s, correlation",
                            "power over 1 s, correlation",
                            "power over 2 s, correlation",
                            "power over 3.1 s, correlation",
                            "power over 6.1 s, correlation",
                            "velocity over 1 s, correlation",
                            "velocity over 6.1 s, correlation"};
using Statistics = std::array<double, kNames.size()>;

Statistics statistics_of(const std::vector<Complex>& samples, double wavelength) {
  double power = 0, second = 0;
  for (const Complex& z : samples) power += std::norm(z), second += std::norm(z) * std::norm(z);
  std::vector<double> powers, logs, velocities, widths;
  for (std::size_t start = 0; start + kBlock <= samples.size(); start += kBlock) {
    double block = 0;
    Complex r1, r2;
    for (std::size_t i = start; i < start + kBlock; ++i) {
      block += std::norm(samples[i]) / kBlock;
      if (i >= start + 1) r1 += samples[i] * std::conj(samples[i - 1]) / (kBlock - 1.0);
      if (i >= start + 2) r2 += samples[i] * std::conj(samples[i - 2]) / (kBlock - 2.0);
    }
    const double per_rad = wavelength / 2 / (2 * kPi * kPri_s);
    powers.push_back(block);
    logs.push_back(std::log(block));
    velocities.push_back(std::arg(r1) * per_rad);  // of approach
    widths.push_back(std::sqrt(-2 * std::log(std::clamp(std::abs(r2) / std::abs(r1), 1e-6, 1.0)) / 3) * per_rad);
  }
  const auto after = [](const std::vector<double>& x, std::size_t blocks) {
    return covariance(x, x, blocks) / covariance(x, x);
  };
  const double count = static_cast<double>(samples.size());
  return {second / count / std::pow(power / count, 2),
          moment_over_k(samples, 3),
          moment_over_k(samples, 4),
          correlation(powers, velocities),
          correlation(logs, widths),
          mean_product(powers, velocities) / mean(powers),
          std::sqrt(covariance(velocities, velocities)),
          mean(widths),
          std::sqrt(covariance(widths, widths)) / mean(widths),
          after(powers, 4),
          after(powers, 8),
          after(powers, 16),
          after(powers, 24),
          after(powers, 48),
          after(velocities, 8),
          after(velocities, 48)};
}

// One range cell of clutter over 131 s.
std::vector<Complex> range_cell(const ClutterSpec& spec, const SeaState& sea, Polarisation polarisation,
                                std::uint64_t seed) {
  RadarSpec radar;
  radar.carrier_ghz = 9.39;
  radar.carrier_count = 1;
  radar.bandwidth_mhz = 7.5;  // c / (2B) 20 m; with Hann's taper a cell as wide as one of 30 m
  radar.pulse_width_us = 8;
  radar.pri_us = 1e6 * kPri_s;
  radar.pulses = 131072;
  radar.polarisation = polarisation;
  radar.range_km = 2.6;
  radar.link_budget.beamwidth_deg = 0.9;
  const PulseTrain train = make_pulse_train(radar, 150, seed, 0);
  const WaveField waves = realise_sea(sea, seed, 0);
  ClutterScene scene;
  scene.radar = radar;
  const double grazing = radians(0.6);
  scene.r_hat = Vec3(std::cos(grazing), 0, std::sin(grazing));
  scene.significant_wave_height_m = sea.significant_wave_height_m;
  scene.waves_towards_rad = sea.propagation_rad;
  scene.waves = &waves;
  const std::vector<Complex> response = clutter_response(train, spec, scene, seed, 0);
  std::vector<Complex> cell;
  for (std::size_t i = 0; i < response.size(); i += train.frequencies()) {
    Complex sum;
    for (std::size_t b = 0; b < train.frequencies(); ++b)
      sum += response[i + b] *
             (1 - std::cos(2 * kPi * (static_cast<double>(b) + 0.5) / static_cast<double>(train.frequencies())));
    cell.push_back(sum);
  }
  return cell;
}

constexpr int kSeeds = 10;

struct Spread {
  Statistics mean{}, deviation{};
};

Spread over_seeds(const ClutterSpec& spec, const SeaState& sea, int seeds,
                  Polarisation polarisation = Polarisation::kVv) {
  Spread spread;
  std::vector<Statistics> all;
  for (int seed = 1; seed <= seeds; ++seed)
    all.push_back(statistics_of(range_cell(spec, sea, polarisation, seed), kSpeedOfLight / 9.39e9));
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    for (const Statistics& one : all) spread.mean[i] += one[i] / seeds;
    for (const Statistics& one : all) spread.deviation[i] += std::pow(one[i] - spread.mean[i], 2) / seeds;
    spread.deviation[i] = std::sqrt(spread.deviation[i]);
  }
  return spread;
}

void print_beside(const Spread& simulated, const Statistics& measured) {
  std::printf("%-34s measured  simulated\n", "");
  for (std::size_t i = 0; i < kNames.size(); ++i)
    std::printf("%-34s %8.3f  %8.3f +- %.3f\n", kNames[i], measured[i], simulated.mean[i], simulated.deviation[i]);
}

SeaState sea_of(double height_m, double period_s) {
  SeaState sea;
  sea.significant_wave_height_m = height_m;
  sea.peak_period_s = period_s;
  sea.order = 1;
  sea.spreading.kind = Spreading::kCos2s;
  return sea;
}

// The measured column of a record: tests/reference/sea_clutter/ipix.csv.
Statistics measured(const std::string& record) {
  std::ifstream file(SEAGLINT_SOURCE_DIR "/tests/reference/sea_clutter/ipix.csv");
  Statistics values{};
  values.fill(std::nan(""));
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string name, high, low;
    std::getline(std::getline(std::getline(fields, name, ';'), high, ';'), low);
    for (std::size_t i = 0; i < kNames.size(); ++i)
      if (name == kNames[i]) values[i] = std::stod(record == "high" ? high : low);
  }
  return values;
}

double named(const Statistics& values, const std::string& name) {
  return values[static_cast<std::size_t>(std::ranges::find(kNames, name) - kNames.begin())];
}

// The height and the period of the measured sea are not known. Those of the waves that have its spread of velocities
// and its period are taken, looking upwind, in a sea of spread s = 10.
TEST(MeasuredClutter, OfAHighSeaIsFasterAndBroaderWhereItIsBright) {
  ClutterSpec spec;
  spec.doppler = ClutterDoppler::kWaveResolved;
  spec.texture_shape = 1.741;
  const Spread simulated = over_seeds(spec, sea_of(2.2, 6.5), kSeeds);
  print_beside(simulated, measured("high"));
  const auto mean = [&](const char* name) { return named(simulated.mean, name); };
  // The shape of the cell, to the uncertainty of a record and that of its mean places across the beam.
  EXPECT_NEAR(mean("second moment") / (2 + 2 / 1.741), 1, 0.05);
  EXPECT_NEAR(mean("third moment over K's"), 1, 0.15);
  EXPECT_NEAR(mean("fourth moment over K's"), 1, 0.15);
  EXPECT_GT(mean("power and velocity, correlation"), 0.4);
  EXPECT_LT(mean("power and velocity, correlation"), 0.75);
  EXPECT_GT(mean("log power and width, correlation"), 0.2);
  EXPECT_LT(mean("log power and width, correlation"), 0.6);
  EXPECT_GT(mean("width, deviation over mean"), 0.35);
  EXPECT_LT(mean("width, deviation over mean"), 0.65);
  EXPECT_LT(mean("power over 3.1 s, correlation"), 0);
  EXPECT_GT(mean("power over 6.1 s, correlation"), 0.1);
  EXPECT_NEAR(mean("velocity, deviation (m/s)") / named(measured("high"), "velocity, deviation (m/s)"), 1, 0.15);
  // The mean of scatterers, by ripples, wind and waves, is 0.67 m/s: the rest is that bright ones are faster.
  EXPECT_NEAR(
      mean("velocity weighted with power (m/s)") / named(measured("high"), "velocity weighted with power (m/s)"), 1,
      0.15);
  const double power_velocity = mean("power and velocity, correlation");
  const double power_width = mean("log power and width, correlation");
  const double weighted_mps = mean("velocity weighted with power (m/s)");
  const double velocity_mps = mean("velocity, deviation (m/s)");
  const double width_mps = mean("width, mean (m/s)");
  const double width_ratio = mean("width, deviation over mean");
  const double fourth_moment = mean("fourth moment over K's");
  const double power_1_s = mean("power over 1 s, correlation");
  const double power_3_s = mean("power over 3.1 s, correlation");
  const double power_6_s = mean("power over 6.1 s, correlation");
  record_figure(power_velocity, 2, "clutter_high_power_velocity");
  record_figure(power_width, 2, "clutter_high_power_width");
  record_figure(weighted_mps, 2, "clutter_high_weighted_mps");
  record_figure(velocity_mps, 2, "clutter_high_velocity_mps");
  record_figure(width_mps, 2, "clutter_high_width_mps");
  record_figure(width_ratio, 2, "clutter_high_width_ratio");
  record_figure(fourth_moment, 2, "clutter_high_fourth_moment");
  record_figure(power_1_s, 2, "clutter_high_power_1_s");
  record_figure(power_3_s, 2, "clutter_high_power_3_s");
  record_figure(power_6_s, 2, "clutter_high_power_6_s");
}

TEST(MeasuredClutter, OfALowSeaIsNot) {
  ClutterSpec spec;
  spec.doppler = ClutterDoppler::kWaveResolved;
  spec.texture_shape = 32.3;
  const Spread simulated = over_seeds(spec, sea_of(0.3, 6), kSeeds);
  print_beside(simulated, measured("low"));
  const auto mean = [&](const char* name) { return named(simulated.mean, name); };
  EXPECT_NEAR(mean("power and velocity, correlation"), 0, 0.15);
  EXPECT_NEAR(mean("velocity, deviation (m/s)") / named(measured("low"), "velocity, deviation (m/s)"), 1, 0.15);
  EXPECT_NEAR(mean("width, mean (m/s)") / named(measured("low"), "width, mean (m/s)"), 1, 0.15);
  EXPECT_NEAR(mean("third moment over K's"), 1, 0.15);
  // Not as measured (-0.09). Simulated: the error of the estimated width is larger where power is low, and little else
  // changes the width here. The bound holds the known difference.
  EXPECT_NEAR(mean("log power and width, correlation"), -0.4, 0.15);
  const double power_velocity = mean("power and velocity, correlation");
  const double power_width = mean("log power and width, correlation");
  const double velocity_mps = mean("velocity, deviation (m/s)");
  const double width_mps = mean("width, mean (m/s)");
  const double width_ratio = mean("width, deviation over mean");
  const double fourth_moment = mean("fourth moment over K's");
  const double power_1_s = mean("power over 1 s, correlation");
  record_figure(power_velocity, 2, "clutter_low_power_velocity");
  record_figure(power_width, 2, "clutter_low_power_width");
  record_figure(velocity_mps, 3, "clutter_low_velocity_mps");
  record_figure(width_mps, 2, "clutter_low_width_mps");
  record_figure(width_ratio, 2, "clutter_low_width_ratio");
  record_figure(fourth_moment, 2, "clutter_low_fourth_moment");
  record_figure(power_1_s, 2, "clutter_low_power_1_s");
}

// A texture independent of the waves has neither their velocity nor their period.
TEST(MeasuredClutter, OfIndependentTextureHasNoPeriod) {
  ClutterSpec spec;
  spec.doppler = ClutterDoppler::kWaveResolved;
  spec.texture = ClutterTexture::kIndependent;
  spec.texture_shape = 1.741;
  spec.doppler_spread_mps = 0.13;
  const Spread simulated = over_seeds(spec, sea_of(2.2, 6.5), 4);
  print_beside(simulated, measured("high"));
  EXPECT_NEAR(named(simulated.mean, "power and velocity, correlation"), 0, 0.1);
  // Speckle takes a quarter of the correlation at every lag; that of the texture falls as e^{-t^2 / 18}.
  EXPECT_NEAR(
      named(simulated.mean, "power over 1 s, correlation") / named(simulated.mean, "power over 0.5 s, correlation"),
      std::exp((0.512 * 0.512 - 1.024 * 1.024) / 18), 0.05);
  EXPECT_NEAR(named(simulated.mean, "power over 6.1 s, correlation"), 0.75 * std::exp(-6.144 * 6.144 / 18), 0.2);
  const double power_velocity = named(simulated.mean, "power and velocity, correlation");
  const double width_ratio = named(simulated.mean, "width, deviation over mean");
  record_figure(power_velocity, 2, "clutter_independent_power_velocity");
  record_figure(width_ratio, 2, "clutter_independent_width_ratio");
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Clutter and noise of absolute level: reflectivity, area, radar equation, and the level of the echo.
#include "radar/echo/sea_clutter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "radar/echo/echo.h"
#include "sim/canonical/point_response.h"
#include "sim/core/numbers/constants.h"
#include "tests/measured.h"

namespace seaglint {
namespace {

// Values of the model at 16 GHz, computed by hand from Gregers-Hansen and Mital (2012), to 0.01 dB.
TEST(SeaReflectivity, HasTheModelsValuesAtSixteenGigahertz) {
  const struct {
    double grazing_deg, sea_state, hh_db, vv_db;
  } rows[] = {{1, 1, -52.43, -49.02}, {1, 3, -39.62, -38.25}, {1, 5, -31.13, -31.11}, {3, 3, -37.85, -35.84}};
  for (const auto& row : rows) {
    EXPECT_NEAR(nrl_reflectivity_db(Polarisation::kHh, radians(row.grazing_deg), 16e9, row.sea_state), row.hh_db,
                0.0051);
    EXPECT_NEAR(nrl_reflectivity_db(Polarisation::kVv, radians(row.grazing_deg), 16e9, row.sea_state), row.vv_db,
                0.0051);
  }
}

TEST(SeaReflectivity, SeaStatesAreThoseOfTheCodeTable) {
  EXPECT_EQ(douglas_sea_state(0), 0);
  const double limits[] = {0.1, 0.5, 1.25, 2.5, 4, 6};
  for (int state = 1; state <= 6; ++state) {
    EXPECT_NEAR(douglas_sea_state(limits[state - 1]), state + 0.5, 1e-12);
    EXPECT_NEAR(douglas_sea_state(limits[state - 1] - 1e-9), state + 0.5, 1e-6);  // no jump
  }
  EXPECT_NEAR(douglas_sea_state(0.875), 3, 1e-12);  // the middle of class 3
}

// Two-way beam of a Gaussian pattern by quadrature against the closed form of the area.
TEST(SeaReflectivity, AreaIsThatOfTheTwoWayBeam) {
  RadarSpec radar;
  radar.range_km = 10;
  radar.link_budget.beamwidth_deg = 2;
  const double width = radians(2);
  double sum = 0;
  const double step = width / 1000;
  for (double phi = -5 * width; phi < 5 * width; phi += step)
    sum += std::exp(-8 * std::log(2.0) * phi * phi / (width * width)) * step;
  EXPECT_NEAR(clutter_patch_area_m2(radar, radians(60), 3) / (10e3 * sum * 3 / 0.5), 1, 1e-9);
}

FrequencyResponse one_point(const PulseTrain& train) {
  const PointSpec point{{7, 0, 0}, 1, {2, 0, 0}};
  return point_response({&point, 1}, Vec3(1, 0, 0), interval_sampling(train, 0));
}

TEST(SeaReflectivity, IsThatOfTheEcho) {
  RadarSpec radar;
  radar.pulses = 64;
  const PulseTrain train = make_pulse_train(radar, 239.8, 1, 2);
  ClutterSpec clutter;
  clutter.level = ClutterLevel::kNrl;
  clutter.texture_shape = 5;
  ClutterScene scene;
  scene.radar = radar;
  const double grazing = radians(3);
  scene.r_hat = Vec3(std::cos(grazing), 0, std::sin(grazing));
  scene.significant_wave_height_m = 0.875;
  double mean = 0, square = 0;
  const int intervals = 300;
  for (int i = 0; i < intervals; ++i) {
    scene.texture_key = i;
    const double power = mean_power(synthesise_echo(train, one_point(train), clutter, 7, i, scene).clutter);
    mean += power / intervals;
    square += power * power / intervals;
  }
  // sigma0 = -35.84 dB at 3 deg, vv, sea state 3; 20 km, 1.5 deg: 20e3 x 0.02618 x 0.7527 x 239.83 / 0.99863 m^2.
  const double expected = std::pow(10, -3.584) * 20e3 * 0.0261799 * 0.752712 * 239.8340 / 0.998630 / (4 * kPi) *
                          mean_power(train.chirp_spectrum);
  const double error = std::sqrt((square - mean * mean) / intervals) / expected;
  std::printf("clutter %.4g m^2, law %.4g, standard error %.2g\n", mean, expected, error);
  record_figure(mean, 3, "clutter_power_m2");
  record_figure(expected, 3, "clutter_power_law_m2");
  EXPECT_LT(error, 0.02);
  EXPECT_NEAR(mean / expected, 1, 4 * error + 0.0012);  // and 0.005 dB of the rounded sigma0
}

// 1 m of scattering amplitude (11 dBsm) at 20 km, 10 kW, 36 us, 40 dB, 16.0875 GHz, 290 K, 4 dB, 6 dB of losses: E = P
// T G^2 lambda^2 / ((4 pi)^2 R^4 L), N0 = k T F, in decibels by hand.
TEST(ReceiverNoise, FollowsTheRadarEquation) {
  const PulseTrain train = make_pulse_train({}, 239.8, 1, 2);
  const double lambda_db = 20 * std::log10(299792458.0 / train.band_centre_hz());
  const double energy_db = 40 - 44.43697 + 80 + lambda_db - 21.98420 - 172.04120 - 6;
  const double density_db = -228.59917 + 24.62398 + 4;
  const double noise_db = 10 * std::log10(thermal_noise_m2(train, {}));
  EXPECT_NEAR(noise_db, density_db - energy_db + 10 * std::log10(40.0), 1e-4);
}

TEST(ReceiverNoise, HasTheSpecifiedRatio) {
  const PulseTrain train = make_pulse_train({}, 239.8, 1, 2);
  ClutterSpec spec;
  spec.enabled = false;
  spec.noise_level = NoiseLevel::kSnr;
  spec.snr_db = 7;
  const Echo echo = synthesise_echo(train, one_point(train), spec, 1, 1);
  EXPECT_TRUE(echo.clutter.empty());
  EXPECT_NEAR(10 * std::log10(mean_power(echo.target) / mean_power(echo.noise)), 7, 1e-9);
  spec.noise_level = NoiseLevel::kThermal;
  const Echo thermal = synthesise_echo(train, one_point(train), spec, 1, 1);
  EXPECT_NEAR(mean_power(thermal.noise) / thermal_noise_m2(train, {}), 1, 4 / std::sqrt(256 * 40.0));
}

TEST(Texture, HasTheSpecifiedCorrelationTime) {
  ClutterSpec spec;
  spec.texture_shape = 1000;  // nearly Gaussian: the generator's correlation is the texture's
  spec.texture_correlation_time_s = 2;
  for (const double lag_s : {0.0, 1.0, 2.0, 5.0}) {
    double first = 0, second = 0, both = 0;
    const int keys = 200, cells = 64;
    for (int key = 0; key < keys; ++key) {
      const std::vector<double> a = sea_texture(cells, 2, spec, 100, 3, key),
                                b = sea_texture(cells, 2, spec, 100 + lag_s, 3, key);
      for (int k = 0; k < cells; ++k) {
        first += (a[k] - 1) * (a[k] - 1);
        second += (b[k] - 1) * (b[k] - 1);
        both += (a[k] - 1) * (b[k] - 1);
      }
    }
    const double law = std::exp(-lag_s * lag_s / 8);
    std::printf("lag %.0f s: %.3f, law %.3f\n", lag_s, both / std::sqrt(first * second), law);
    // About 64 / (2 sqrt(pi)) independent cells a key.
    EXPECT_NEAR(both / std::sqrt(first * second), law, 4 * (1 - law * law) / std::sqrt(200 * 18.0) + 1e-3);
  }
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "radar/echo/echo.h"
#include "radar/echo/sea_clutter.h"
#include "radar/echo/sea_scatterers.h"
#include "sim/canonical/point_response.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dispersion.h"
#include "sim/scenario/scenario.h"
#include "sim/sea/realisation.h"
#include "tests/measured.h"

namespace seaglint {
namespace {

constexpr double kWavelength = 0.01864;

SeaState waves_towards(double degrees) {
  SeaState state;
  state.propagation_rad = radians(degrees);
  state.order = 1;
  return state;
}

// Velocity of the water at places in range within -window / 2 and window / 2, at the start of an interval and at its
// end, 0.064 s later.
std::vector<double> water_velocities(const ClutterScene& scene, double window_m, int count, std::uint64_t index,
                                     int node = 0) {
  ClutterSpec spec;
  spec.doppler = ClutterDoppler::kWaveResolved;
  spec.texture = ClutterTexture::kIndependent;
  return sea_scatterers({.spec = spec,
                         .scene = scene,
                         .texture = {},
                         .count = count,
                         .window_m = window_m,
                         .duration_s = 0.064,
                         .seed = 1,
                         .index = index})
      .at_node(node)
      .velocity_mps;
}

ClutterScene scene_of(const WaveField& waves) {
  ClutterScene scene;
  scene.radar.polarisation = Polarisation::kVv;
  scene.significant_wave_height_m = 1;
  scene.waves = &waves;
  return scene;
}

TEST(SeaVelocity, IsTheSumOfRipplesDriftAndWind) {
  const WaveField waves = realise_sea(waves_towards(180), 1, 1);  // away from a radar ahead
  const ClutterScene scene = scene_of(waves);
  // Bragg ripples of 4 pi / 18.64 mm: sqrt(9.81 / 674.2 + 0.074 / 1025 x 674.2) = 0.2514 m/s. Wind of Hs 1 m: sqrt(9.81
  // / 0.22) = 6.678 m/s, 3 % of it 0.2003 m/s. Stokes drift (2 / g) integral w^3 S dw, here of the components.
  double stokes = 0;
  for (const WaveComponent& wave : waves.components())
    stokes += wave.amplitude * wave.amplitude * std::pow(wave.omega, 3) / kGravity;
  const VelocityMoments vv = clutter_velocity_moments({}, scene, kWavelength);
  std::printf("vv %.4f m/s with a Stokes drift of %.4f, spread %.4f m/s\n", vv.mean_mps, stokes, vv.spread_mps);
  EXPECT_NEAR(vv.mean_mps, 0.2514 + 0.2003 + stokes, 2e-4);
  EXPECT_GT(stokes, 0.01);
}

TEST(SeaVelocity, IsOppositeFromBehindNoneFromTheSideAndFasterInHh) {
  const WaveField receding = realise_sea(waves_towards(180), 1, 1), approaching = realise_sea(waves_towards(0), 1, 1),
                  abeam = realise_sea(waves_towards(90), 1, 1);
  const double mean = clutter_velocity_moments({}, scene_of(receding), kWavelength).mean_mps;
  EXPECT_NEAR(clutter_velocity_moments({}, scene_of(approaching), kWavelength).mean_mps, -mean, 1e-12);
  EXPECT_NEAR(clutter_velocity_moments({}, scene_of(abeam), kWavelength).mean_mps, 0, 1e-12);
  ClutterScene hh = scene_of(receding);
  hh.radar.polarisation = Polarisation::kHh;
  EXPECT_NEAR(clutter_velocity_moments({}, hh, kWavelength).mean_mps, 1.5 * mean, 1e-12);
  // Long-crested waves viewed from the side move only vertically: no velocity along a level line of sight.
  EXPECT_NEAR(clutter_velocity_moments({}, scene_of(abeam), kWavelength).spread_mps, 0, 1e-9);
}

// The clutter drifts as a particle of the second-order surface does: in water of 8 m depth, with orbits 1.54 times as
// long as high, 1.7 times as fast as in deep water.
TEST(SeaVelocity, ContainsTheDriftOfAParticleInAnyDepth) {
  const double omega = 2 * kPi / 8, period = 8, amplitude = 0.02;
  for (const double depth : {8.0, 25.0, kDeepWater}) {
    const double k = wavenumber_at(omega, depth);
    const WaveField wave({WaveComponent{omega, amplitude, 0, k, {1, 0}}}, 2, 10, depth);
    // Ten of the particle's own periods, up to the exact moment within the last step.
    const double step = period / 4000, end = 20 * kPi;
    double x = 0, t = 0, phase = 0;
    while (phase < end) {
      const double half = x + 0.5 * step * wave.surface(x, 0, t).velocity.x();
      const double displacement = step * wave.surface(half, 0, t + 0.5 * step).velocity.x();
      const double fraction = std::min(1.0, (end - phase) / (omega * step - k * displacement));
      x += fraction * displacement;
      t += fraction * step;
      phase = fraction < 1 ? end : phase + omega * step - k * displacement;
    }
    ClutterScene scene = scene_of(wave);
    scene.significant_wave_height_m = 0;  // no wind
    const double bragg_k = 4 * kPi / kWavelength, bragg = std::sqrt(kGravity / bragg_k + 0.074 / 1025 * bragg_k);
    const double drift = -clutter_velocity_moments({}, scene, kWavelength).mean_mps - bragg;
    std::printf("depth %.4g m: drift %.6g mm/s, of a particle %.6g, a^2 w k %.6g\n", depth, 1e3 * drift, 1e3 * x / t,
                1e3 * amplitude * amplitude * omega * k);
    // The next order is smaller by (3/8 Ur)^2 = (3/8 a / (k^2 h^3))^2 and (k a)^2, 4e-6 at most; the error of the
    // midpoint rule is (w step)^2 / 24 = 1e-7 of orbital speeds that are up to 800 times the drift.
    EXPECT_NEAR(drift / (x / t), 1, 1e-4) << depth << " m";
  }
}

TEST(SeaVelocity, SpreadIsThatOfTheWaterAndOfFloatingScatterers) {
  const WaveField waves = realise_sea(waves_towards(150), 1, 1);
  ClutterScene scene = scene_of(waves);
  const double grazing = radians(10);
  scene.r_hat = Vec3(std::cos(grazing), 0, std::sin(grazing));
  scene.radar.range_km = 2;
  const double spread = clutter_velocity_moments({}, scene, kWavelength).spread_mps;
  // The velocity of the water at many places and times.
  double square = 0, count = 0;
  for (int moment = 0; moment < 25; ++moment) {
    scene.start_s = 37.0 * moment;
    for (const double v : water_velocities(scene, 8000, 400, moment)) square += v * v, ++count;
  }
  std::printf("spread %.4f m/s, of the water %.4f\n", spread, std::sqrt(square / count));
  // 8 km hold about 80 waves of 100 m, 25 times: 2000 independent values.
  EXPECT_NEAR(std::sqrt(square / count) / spread, 1, 4 / std::sqrt(2 * 2000.0));
}

TEST(ScatterersOnTheWaves, MoveWithThem) {
  // One wave of 1 m amplitude and 8 s towards the radar: u = a w cos(w t - k x) along it; the radial velocity is -u.
  const double omega = 2 * kPi / 8, k = omega * omega / kGravity;
  const WaveField wave({WaveComponent{omega, 1, 0, k, {1, 0}}}, 1, 10);
  ClutterScene scene = scene_of(wave);
  scene.radar.link_budget.beamwidth_deg = 0.01;
  scene.start_s = 3;
  const std::vector<double> velocity = water_velocities(scene, 50, 2, 1), later = water_velocities(scene, 50, 2, 1, 1);
  for (const int i : {0, 1}) {
    const double phase = omega * 3 - k * 25 * i;  // x = -range, the second is 25 m nearer
    EXPECT_NEAR(velocity[i], -omega * std::cos(phase), 1e-9);
    EXPECT_NEAR((later[i] - velocity[i]) / 0.064, omega * omega * std::sin(phase),
                0.5 * 0.064 * std::pow(omega, 3) + 1e-9);
  }
}

// At order 2 the water's velocity at the moving surface has a mean, that of eta1 du1/dz: 1/2 a^2 w k of every component
// in the quadratic sums. It is part of the Stokes drift, which clutter_velocity_moments contains, and is therefore
// not contained in the scatterers' own velocity.
TEST(ScatterersOnTheWaves, HaveZeroMeanRelativeToTheSea) {
  SeaState state = waves_towards(180);
  state.significant_wave_height_m = 2;
  state.peak_period_s = 6.5;
  state.order = 2;
  const WaveField waves = realise_sea(state, 1, 1);
  double half_drift = 0;
  for (std::size_t i = 0; i < waves.second_order_count(); ++i) {
    const WaveComponent& wave = waves.components()[i];
    half_drift += 0.5 * wave.amplitude * wave.amplitude * wave.omega * wave.wavenumber;
  }
  ClutterScene scene = scene_of(waves);
  scene.radar.link_budget.beamwidth_deg = 1e-9;
  // Over 40 km and 10 moments, each range weighted by Hann's window: the residual of a wave is its spectrum's side
  // lobe.
  double sum = 0, weights = 0;
  for (int moment = 0; moment < 10; ++moment) {
    scene.start_s = 37.0 * moment;
    constexpr int kPlaces = 4000;
    const std::vector<double> velocity = water_velocities(scene, 40000, kPlaces, moment);
    for (int i = 0; i < kPlaces; ++i) {
      const double weight = 1 - std::cos(2 * kPi * (signed_index(i, kPlaces) + kPlaces / 2 + 0.5) / kPlaces);
      sum += weight * velocity[i];
      weights += weight;
    }
  }
  std::printf("mean %.4f m/s, half of the Stokes drift %.4f m/s\n", sum / weights, half_drift);
  // Difference waves longer than the window do not average out. Adjacent ones are one or two kilometres long (0.01
  // rad/s), but strata are filled at random and a tenth of the pairs is ten times as close: of the hundred components
  // with the energy ten pairs of random phase, sqrt(10) / 100 of the drift; three standard deviations.
  EXPECT_NEAR(sum / weights, 0, 3 * std::sqrt(10.0) / 100 * half_drift);
  EXPECT_GT(half_drift, 0.05);
}

// The frame of a ship that is under way moves with it, and so does the radar.
TEST(ClutterOfMovingShip, HasTheVelocityOfTheWaterRelativeToTheShip) {
  const WaveField waves = realise_sea(waves_towards(150), 1, 1), calm;
  ClutterScene scene = scene_of(waves);
  const double grazing = radians(2), azimuth = radians(30);
  scene.r_hat = Vec3(std::cos(grazing) * std::cos(azimuth), std::cos(grazing) * std::sin(azimuth), std::sin(grazing));
  scene.start_s = 20;
  ClutterScene sailing = scene;
  sailing.target_velocity_mps = {10, 0, 0};
  // Viewed from ahead the water drifts astern, away from the radar.
  const double past = 10 * scene.r_hat.x();
  EXPECT_NEAR(clutter_velocity_moments({}, sailing, kWavelength).mean_mps,
              clutter_velocity_moments({}, scene, kWavelength).mean_mps + past, 1e-12);
  sailing.waves = &calm;
  EXPECT_NEAR(clutter_velocity_moments({}, sailing, kWavelength).mean_mps, past, 1e-12);
  // A current astern moves the water likewise, with its waves: those of a scatterer stay.
  ClutterScene flowing = scene;
  flowing.current_mps = {-10, 0, 0};
  EXPECT_NEAR(clutter_velocity_moments({}, flowing, kWavelength).mean_mps,
              clutter_velocity_moments({}, scene, kWavelength).mean_mps + past, 1e-12);
  EXPECT_NEAR(platform_doppler_spread_mps(flowing), platform_doppler_spread_mps(sailing), 1e-12);
  const std::vector<double> at_rest = water_velocities(scene, 140, 2, 1),
                            in_current = water_velocities(flowing, 140, 2, 1);
  for (const int i : {0, 1})
    EXPECT_NEAR(in_current[static_cast<std::size_t>(i)], at_rest[static_cast<std::size_t>(i)], 1e-12);
  sailing.waves = &waves;

  // The waves are those at the ship's present position: 200 m further along x, x = -range cos(azimuth) without beam.
  scene.radar.link_budget.beamwidth_deg = sailing.radar.link_budget.beamwidth_deg = 1e-9;
  const std::vector<double> velocity = water_velocities(sailing, 140, 2, 1);
  for (const int i : {0, 1}) {
    const double x = 200 + 70 * i / std::cos(grazing) * std::cos(azimuth),
                 y = 70 * i / std::cos(grazing) * std::sin(azimuth);
    EXPECT_NEAR(velocity[i], -scene.r_hat.dot(waves.surface(x, y, 20).velocity), 1e-6);
  }
  // The velocity across the line of sight spreads the Doppler over the whole beam.
  EXPECT_EQ(platform_doppler_spread_mps(scene), 0);
  scene.radar.link_budget.beamwidth_deg = sailing.radar.link_budget.beamwidth_deg = 2;
  EXPECT_NEAR(platform_doppler_spread_mps(sailing),
              10 * std::sin(azimuth) * radians(2) / (4 * std::sqrt(std::log(2.0))), 1e-9);
}

TEST(ClutterDoppler, EqualsTheVelocityMomentsOfTheSea) {
  RadarSpec radar;
  radar.carrier_count = 1;
  radar.pulses = 64;
  const PulseTrain train = make_pulse_train(radar, 100, 1, 2);
  const double wavelength = kSpeedOfLight / train.band_centre_hz();
  const WaveField waves = realise_sea(waves_towards(180), 1, 1);
  ClutterScene scene = scene_of(waves);
  scene.radar = radar;
  constexpr std::size_t kLag = 4;
  for (const ClutterDoppler doppler : {ClutterDoppler::kSeaState, ClutterDoppler::kWaveResolved}) {
    ClutterSpec spec;
    spec.doppler = doppler;
    spec.texture = ClutterTexture::kIndependent;
    spec.doppler_spread_mps = 0.1;
    Complex sum;
    double power = 0;
    for (int i = 0; i < 300; ++i) {
      scene.start_s = 41.0 * i;
      scene.texture_key = i;
      const std::vector<Complex> response = clutter_response(train, spec, scene, 3, i);
      const std::size_t bins = train.frequencies();
      for (std::size_t j = kLag * bins; j < response.size(); ++j) {
        sum += response[j] * std::conj(response[j - kLag * bins]);
        power += 0.5 * (std::norm(response[j]) + std::norm(response[j - kLag * bins]));
      }
    }
    // For a small lag the phase gives the mean velocity, the loss of magnitude the spread.
    const VelocityMoments sea = clutter_velocity_moments(spec, scene, wavelength);
    const double per_mps = 4 * kPi * kLag * train.pri_s / wavelength, mean = -std::arg(sum) / per_mps;
    const double spread = std::sqrt(-2 * std::log(std::abs(sum) / power)) / per_mps;
    std::printf("mean %.3f (law %.3f), spread %.3f (law %.3f) m/s\n", mean, sea.mean_mps, spread,
                std::hypot(sea.spread_mps, 0.1));
    // 300 intervals of two to three waves' worth of water each: about 5 % of the spread.
    EXPECT_NEAR(mean, sea.mean_mps, 4 * sea.spread_mps / std::sqrt(300.0));
    EXPECT_NEAR(spread / std::hypot(sea.spread_mps, 0.1), 1, 4 / std::sqrt(2 * 300.0));
  }
}

TEST(GammaTexture, RisesWithItsGeneratorForEveryShape) {
  for (const double shape : {0.1, 0.3, 1.0, 2.0, 17.0, 1000.0}) {
    double last = -1;
    for (double y = -8; y <= 8; y += 0.25) {
      const double value = gamma_texture(shape, y);
      EXPECT_GT(value, last) << shape << " " << y;
      last = value;
    }
  }
}

// Moments by integration over the normal density: mean 1, variance 1/shape.
TEST(GammaTexture, HasMeanOneAndVarianceOneOverShape) {
  for (const double shape : {0.5, 2.0, 30.0}) {
    double mean = 0, square = 0;
    const double step = 0.01;
    for (double y = -8; y <= 8; y += step) {
      const double weight = step * std::exp(-y * y / 2) / std::sqrt(2 * 3.14159265358979323846);
      const double value = gamma_texture(shape, y);
      mean += weight * value;
      square += weight * value * value;
    }
    EXPECT_NEAR(mean, 1, 1e-6);
    EXPECT_NEAR(square - mean * mean, 1 / shape, 1e-5 / shape);
  }
}

// Clutter and noise of absolute level: reflectivity, area, radar equation, and the level of the echo.

FrequencyResponse point_of_one_metre(const PulseTrain& train) {
  const PointSpec point{{7, 0, 0}, 1, {2, 0, 0}};
  return point_response({&point, 1}, Vec3(1, 0, 0), interval_sampling(train, 0));
}

TEST(ClutterLevel, IsTheReflectivityOfTheScene) {
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
    const double power = mean_power(synthesise_echo(train, point_of_one_metre(train), clutter, 7, i, scene).clutter);
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
  const double density_db = -228.59917 + 24.62398 + 4, noise_db = 10 * std::log10(thermal_noise_m2(train, {}));
  EXPECT_NEAR(noise_db, density_db - energy_db + 10 * std::log10(40.0), 1e-4);
}

TEST(ReceiverNoise, HasTheSpecifiedRatio) {
  const PulseTrain train = make_pulse_train({}, 239.8, 1, 2);
  ClutterSpec spec;
  spec.enabled = false;
  spec.noise_level = NoiseLevel::kSnr;
  spec.snr_db = 7;
  const Echo echo = synthesise_echo(train, point_of_one_metre(train), spec, 1, 1);
  EXPECT_TRUE(echo.clutter.empty());
  EXPECT_NEAR(10 * std::log10(mean_power(echo.target) / mean_power(echo.noise)), 7, 1e-9);
  spec.noise_level = NoiseLevel::kThermal;
  const Echo thermal = synthesise_echo(train, point_of_one_metre(train), spec, 1, 1);
  EXPECT_NEAR(mean_power(thermal.noise) / thermal_noise_m2(train, {}), 1, 4 / std::sqrt(256 * 40.0));
}

// By hand: 2 deg, a cell of 1.5 m at 20 km in a beam of 1.5 deg, 394 m across, vv: 2/3 x 0.301 + 5/8 x 2.772 - 1.39 -+
// 1/3 along and across the waves.
TEST(Texture, HasTheShapeOfMeasuredClutter) {
  ClutterScene scene;
  scene.radar.range_km = 20;
  scene.radar.link_budget.beamwidth_deg = 1.5;
  scene.radar.polarisation = Polarisation::kVv;
  scene.r_hat = Vec3(std::cos(radians(2)), 0, std::sin(radians(2)));
  const auto shape = [&](double frequency_hz) { return k_shape(scene, frequency_hz, 1.5); };
  EXPECT_TRUE(shape(9.4e9).is_within_range);
  EXPECT_NEAR(std::log10(shape(9.4e9).value), 0.2098, 2e-3);
  scene.waves_towards_rad = radians(90);
  EXPECT_NEAR(std::log10(shape(9.4e9).value), 0.8765, 2e-3);
  const double vv = shape(9.4e9).value;
  scene.radar.polarisation = Polarisation::kHh;
  EXPECT_NEAR(vv / shape(9.4e9).value, std::pow(10, 0.7), 1e-9);
  EXPECT_FALSE(shape(16e9).is_within_range);
  scene.radar.range_km = 2;  // 39 m across
  EXPECT_FALSE(shape(9.4e9).is_within_range);
}

TEST(Texture, HasTheSpecifiedCorrelationTime) {
  const int cells = 64;
  for (const double lag_s : {0.0, 1.0, 2.0, 5.0}) {
    double first = 0, second = 0, both = 0;
    const int keys = 200;
    for (int key = 0; key < keys; ++key) {
      const std::vector<double> a = ring_field(cells, 2, 2, 100, key), b = ring_field(cells, 2, 2, 100 + lag_s, key);
      for (int k = 0; k < cells; ++k) {
        first += a[k] * a[k];
        second += b[k] * b[k];
        both += a[k] * b[k];
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

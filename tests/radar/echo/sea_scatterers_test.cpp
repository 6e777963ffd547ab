// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/sea_scatterers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <vector>

#include "radar/echo/sea_clutter.h"
#include "radar/echo/speckle.h"
#include "sim/core/numbers/constants.h"
#include "sim/scenario/scenario.h"
#include "sim/sea/realisation.h"

namespace seaglint {
namespace {

ClutterSpec by_waves() {
  ClutterSpec spec;
  spec.doppler = ClutterDoppler::kWaveResolved;
  return spec;
}

ClutterScene scene_of(const WaveField& waves, double grazing_deg, double towards_deg = 0) {
  ClutterScene scene;
  scene.radar.polarisation = Polarisation::kVv;
  scene.radar.range_km = 2;
  scene.radar.link_budget.beamwidth_deg = 0.5;
  scene.r_hat = Vec3(std::cos(radians(grazing_deg)), 0, std::sin(radians(grazing_deg)));
  scene.significant_wave_height_m = 2;
  scene.waves_towards_rad = radians(towards_deg);
  scene.waves = &waves;
  return scene;
}

SeaState sea_towards(double towards_deg, double height_m = 2) {
  SeaState sea;
  sea.significant_wave_height_m = height_m;
  sea.peak_period_s = 6.5;
  sea.propagation_rad = radians(towards_deg);
  sea.order = 1;
  sea.spreading.kind = Spreading::kCos2s;
  return sea;
}

// A regular wave of 0.5 m and 7 s towards the radar, or away from it.
constexpr double kOmega = 2 * kPi / 7;
WaveField regular_wave(double sign) {
  return WaveField({WaveComponent{kOmega, 0.5, 0, kOmega * kOmega / kGravity, {sign, 0}}}, 1, 0);
}

ScattererRequest request_for(const ClutterSpec& spec, const ClutterScene& scene, const TextureParameters& texture,
                             int count, double window_m, double duration_s, std::uint64_t seed) {
  return {.spec = spec,
          .scene = scene,
          .texture = texture,
          .per_cell = 10,
          .count = count,
          .window_m = window_m,
          .duration_s = duration_s,
          .seed = seed,
          .index = seed};
}

// All nodes of an interval of modulated scatterers, [node][scatterer].
struct Record {
  double step_s = 0;
  std::vector<double> amplitude, velocity_mps, width_mps;
};

Record scatterers_in(const ClutterScene& scene, const TextureParameters& texture, int count, double window_m,
                     double duration_s, std::uint64_t seed) {
  const ClutterSpec spec = by_waves();
  const SeaScatterers scatterers = sea_scatterers(request_for(spec, scene, texture, count, window_m, duration_s, seed));
  Record record{scatterers.step_s, {}, {}, {}};
  for (int node = 0; node <= std::lround(duration_s / scatterers.step_s); ++node) {
    const ScattererState state = scatterers.at_node(node);
    record.amplitude.insert(record.amplitude.end(), state.amplitude.begin(), state.amplitude.end());
    record.velocity_mps.insert(record.velocity_mps.end(), state.velocity_mps.begin(), state.velocity_mps.end());
    record.width_mps.insert(record.width_mps.end(), state.width_mps.begin(), state.width_mps.end());
  }
  return record;
}

// Far above the slopes every facet is illuminated, p sigma / tan(grazing); far below, the mean of the slopes that face
// the radar is sigma / sqrt(2 pi), whatever its size.
TEST(WaveModulation, HasTheLimitsOfTiltAndShadow) {
  const double slope = 0.5 * kOmega * kOmega / kGravity / std::sqrt(2.0);
  const WaveField waves = regular_wave(1);
  const auto at = [&](double grazing_deg) { return wave_modulation({}, scene_of(waves, grazing_deg), 10, 10); };
  EXPECT_NEAR(at(40).tilt_log_deviation / (2.6 * slope / std::tan(radians(40))), 1, 1e-9);
  EXPECT_NEAR(at(0.01).tilt_log_deviation / (2.6 * std::sqrt(2 * kPi)), 1, 0.01);
  EXPECT_NEAR(at(1).breaking, std::pow(slope / 0.06, 2), 1e-9);
  EXPECT_NEAR(at(0.5).rho, 0.9, 1e-9);
  EXPECT_LT(at(40).rho, 0.5);
  // Long crests along the line of sight neither tilt nor shadow.
  const ClutterScene scene = scene_of(waves, 1);
  ClutterScene across = scene;
  across.r_hat = Vec3(0, scene.r_hat.x(), scene.r_hat.z());
  EXPECT_EQ(wave_modulation({}, across, 10, 10).rho, 0);
  EXPECT_NEAR(wave_modulation({}, across, 10, 10).breaking, std::pow(slope / 0.06, 2), 1e-9);
}

// A cell averages over its scatterers, whose shape is at least 0.1.
TEST(WaveModulation, HasTheShapeThatACellOfItsSizeCanHave) {
  const WaveField waves = realise_sea(sea_towards(0), 5, 1);
  const auto of = [&](double shape, double cell_m) {
    return wave_modulation({.shape = shape, .correlation_cells = 8 / cell_m}, scene_of(waves, 0.6),
                           static_cast<int>(cell_m), cell_m);
  };
  EXPECT_EQ(of(2, 30).cell_shape, 2);
  EXPECT_GT(of(2, 30).shape, 0.2);
  EXPECT_LT(of(2, 30).shape, 2);
  EXPECT_EQ(of(0.2, 30).shape, 0.1);
  EXPECT_GT(of(0.2, 30).cell_shape, 0.25);
  EXPECT_LT(of(0.2, 30).cell_shape, 1);
  EXPECT_NEAR(of(1000, 1).cell_shape, 1000, 1e-6);
}

// Power of a range cell, weighted by the response of Hann's taper: mean 1 and variance 1 / shape at any grazing angle
// and direction of the waves, in beams of 10 m and 300 m.
TEST(ModulatedScatterers, GiveACellTheShapeOfTheTexture) {
  constexpr int kPerCell = 10, kCells = 24;
  constexpr double kCell_m = 10;
  for (const auto& [shape, grazing_deg, towards_deg, range_km] : {std::array{0.7, 0.6, 0.0, 2.0},
                                                                  {2.0, 0.6, 90.0, 2.0},
                                                                  {2.0, 8.0, 180.0, 2.0},
                                                                  {10.0, 1.0, 0.0, 2.0},
                                                                  {2.0, 1.0, 90.0, 60.0}}) {
    double mean = 0, square = 0, mean_2 = 0;
    int samples = 0;
    const int seeds = 1000;
    for (int seed = 1; seed <= seeds; ++seed) {
      SeaState sea = sea_towards(towards_deg);
      sea.components = 128;
      const WaveField waves = realise_sea(sea, seed, 1);
      ClutterScene scene = scene_of(waves, grazing_deg, towards_deg);
      scene.radar.range_km = range_km;
      const ClutterSpec spec = by_waves();
      const TextureParameters texture{.shape = shape, .correlation_cells = 0.8, .correlation_time_s = 1};
      const ScattererState scatterers =
          sea_scatterers(request_for(spec, scene, texture, kPerCell * kCells, kCell_m * kCells, 0.05, seed)).at_node(0);
      double of_seed = 0;
      for (int cell = 0; cell < 4; ++cell) {
        double power = 0, weights = 0;
        for (int i = -2 * kPerCell; i <= 2 * kPerCell; ++i) {
          const auto sinc = [](double x) { return x == 0 ? 1 : std::sin(kPi * x) / (kPi * x); };
          const double x = i / 10.0, response = sinc(x) + 0.5 * (sinc(x - 1) + sinc(x + 1));
          const int k = (i + (5 * cell - 8) * kPerCell + kPerCell * kCells) % (kPerCell * kCells);
          const double amplitude = scatterers.amplitude[k];
          power += response * response * amplitude * amplitude * kPerCell * kCells;
          weights += response * response;
        }
        power /= weights;
        of_seed += power / 4;
        square += power * power;
        ++samples;
      }
      mean += of_seed;
      mean_2 += of_seed * of_seed;
    }
    mean /= seeds;
    const double error = std::sqrt((mean_2 / seeds - mean * mean) / seeds);
    const double variance = square / samples - mean * mean;
    std::printf(
        "shape %.3g, grazing %.2g deg, waves towards %3.0f deg, %g km: mean %.3f +- %.3f, shape of cells %.3f\n", shape,
        grazing_deg, towards_deg, range_km, mean, error, 1 / variance);
    EXPECT_NEAR(mean, 1, 4 * error);
    // Variance of a sample variance of gamma variates of shape v: (2 + 6 / v) / n of its square, of cells that are half
    // independent; 3 % for powers of the correlation averaged over the beam.
    EXPECT_NEAR(variance * shape, 1, 4 * std::sqrt((2 + 6 / shape) / (0.5 * samples)) + 0.03);
  }
}

// Mean power over the phase of a regular wave: its maximum is before the crest where waves approach the radar, and
// behind it where they recede, by the lead of the slope that faces the radar.
TEST(ModulatedScatterers, AreBrightestOnTheSlopeThatFacesTheRadar) {
  for (const double sign : {1.0, -1.0}) {
    const WaveField waves = regular_wave(sign);
    Complex first, velocity;
    for (int seed = 1; seed <= 40; ++seed) {
      const ClutterScene scene = scene_of(waves, 0.6, sign > 0 ? 0 : 180);
      const Record scatterers =
          scatterers_in(scene, {.shape = 2, .correlation_cells = 0.8, .correlation_time_s = 1}, 30, 30, 7, seed);
      const std::size_t nodes = scatterers.amplitude.size() / 30 - 1;
      for (std::size_t node = 0; node < nodes; ++node) {  // one period
        const double angle = kOmega * static_cast<double>(node) * scatterers.step_s;
        const std::size_t i = node * 30;  // scatterer 0, at the reference point
        first += scatterers.amplitude[i] * scatterers.amplitude[i] * std::polar(1.0, angle);
        velocity -= scatterers.velocity_mps[i] * std::polar(1.0, angle);
      }
    }
    // The crest passes at angle 0: a maximum at the angle p contributes e^{j p}.
    std::printf("waves %s: power leads the crest by %.1f deg, velocity of approach %.1f deg\n",
                sign > 0 ? "approach" : "recede", -degrees(std::arg(first)), -degrees(std::arg(velocity)));
    EXPECT_NEAR(degrees(std::arg(first)), -25 * sign, 5);
    EXPECT_GT(sign * velocity.real(), 0);
  }
}

// The state of the scatterers depends on time alone, not on where the interval begins.
TEST(ModulatedScatterers, ContinueFromIntervalToInterval) {
  const WaveField waves = realise_sea(sea_towards(0), 5, 1);
  ClutterScene scene = scene_of(waves, 1);
  const TextureParameters texture{.shape = 1, .correlation_cells = 0.8, .correlation_time_s = 1, .spread_mps = 0.2};
  const Record first = scatterers_in(scene, texture, 60, 60, 1, 3);
  scene.start_s = 0.5;
  const Record second = scatterers_in(scene, texture, 60, 60, 1, 3);
  for (int k = 0; k < 60; ++k) {
    EXPECT_NEAR(first.amplitude[5 * 60 + k], second.amplitude[k], 1e-9);
    EXPECT_NEAR(first.velocity_mps[5 * 60 + k], second.velocity_mps[k], 1e-9);
    EXPECT_NEAR(first.width_mps[5 * 60 + k], second.width_mps[k], 1e-9);
  }
}

// Scatterers drift with the mean velocity and re-enter the window on its other side; the velocity is that of the water
// there and, along the waves, the given multiple of the width beyond its mean.
TEST(ModulatedScatterers, MoveWithTheWaterAndFasterWhereBroader) {
  for (const auto& [towards_deg, polarisation, excess] :
       {std::tuple(0.0, Polarisation::kVv, -2.0), std::tuple(180.0, Polarisation::kVv, 2.0),
        std::tuple(0.0, Polarisation::kHh, -4.0)}) {
    const WaveField waves = realise_sea(sea_towards(towards_deg), 5, 1);
    ClutterScene scene = scene_of(waves, 1, towards_deg);
    scene.radar.polarisation = polarisation;
    scene.radar.link_budget.beamwidth_deg = 1e-9;
    scene.start_s = 7;
    const ClutterSpec spec = by_waves();
    const TextureParameters texture{.shape = 1, .correlation_cells = 0.8, .correlation_time_s = 1, .spread_mps = 0.2};
    ScattererRequest request = request_for(spec, scene, texture, 30, 30, 2, 3);
    request.mean_mps = -20;
    const SeaScatterers scatterers = sea_scatterers(request);
    const double mean = 0.2 * wave_modulation(texture, scene, 10, 10).mean_width();
    for (const int node : {0, 1, 20}) {
      const ScattererState state = scatterers.at_node(node);
      const double t = node * scatterers.step_s;
      for (int k = 0; k < 30; ++k) {
        double range_m = k - 20 * t;
        while (range_m < -15) range_m += 30;
        while (range_m >= 15) range_m -= 30;
        const Vec3 water = waves.surface(-range_m / scene.r_hat.x(), 0, 7 + t).velocity;
        EXPECT_NEAR(state.velocity_mps[k] + scene.r_hat.dot(water),
                    excess * scene.r_hat.x() * (state.width_mps[k] - mean), 1e-7);  // the beam is 1e-8 m wide
        EXPECT_GT(state.width_mps[k], 0.2);
      }
    }
  }
}

// Power of independent scatterers is constant in short intervals; in long ones power and velocity at a node are those
// of an interval that begins there.
TEST(IndependentScatterers, ChangeInLongIntervals) {
  const WaveField waves = realise_sea(sea_towards(0), 5, 1);
  const ClutterScene scene = scene_of(waves, 1);
  ClutterSpec spec = by_waves();
  spec.texture = ClutterTexture::kIndependent;
  const TextureParameters texture{.shape = 2, .correlation_cells = 5, .correlation_time_s = 3};
  const auto in = [&](const ClutterScene& of, double duration_s) {
    return sea_scatterers(request_for(spec, of, texture, 400, 400, duration_s, 3));
  };
  const SeaScatterers brief = in(scene, 0.064), longer = in(scene, 30);
  EXPECT_TRUE(brief.is_steady);
  EXPECT_EQ(brief.step_s, 0.064);
  EXPECT_EQ(brief.at_node(1).amplitude, brief.at_node(0).amplitude);
  EXPECT_FALSE(longer.is_steady);
  EXPECT_EQ(longer.at_node(0).amplitude, brief.at_node(0).amplitude);
  ClutterScene after = scene;
  after.start_s = 30 * longer.step_s;  // one correlation time
  const ScattererState node = longer.at_node(30), next = in(after, 0.064).at_node(0);
  EXPECT_NE(next.amplitude, brief.at_node(0).amplitude);
  for (int k = 0; k < 400; ++k) {
    EXPECT_NEAR(node.amplitude[k], next.amplitude[k], 1e-12);
    EXPECT_NEAR(node.velocity_mps[k], next.velocity_mps[k], 1e-9);
  }
}

// Sea spikes of hh: local power changes within tenths of a second, and its brightest hundredth is faster.
TEST(ModulatedScatterers, HaveSpikesInHh) {
  const WaveField waves = realise_sea(sea_towards(0), 5, 1);
  const TextureParameters texture{.shape = 0.5, .correlation_cells = 0.8, .correlation_time_s = 1, .spread_mps = 0.2};
  double change[2], fast[2];
  for (const bool hh : {false, true}) {
    ClutterScene scene = scene_of(waves, 1);
    if (hh) scene.radar.polarisation = Polarisation::kHh;
    double same = 0, later = 0, sum = 0, bright = 0, bright_velocity = 0, velocity = 0;
    int count = 0;
    for (int seed = 1; seed <= 10; ++seed) {
      const Record scatterers = scatterers_in(scene, texture, 100, 100, 20, seed);
      const std::size_t lag = 3 * 100;  // 0.3 s
      for (std::size_t i = 0; i + lag < scatterers.amplitude.size(); ++i, ++count) {
        const double power = 100 * std::pow(scatterers.amplitude[i], 2),
                     after = 100 * std::pow(scatterers.amplitude[i + lag], 2);
        sum += power;
        same += power * power;
        later += power * after;
        velocity -= scatterers.velocity_mps[i];
        if (power > 12) bright += 1, bright_velocity -= scatterers.velocity_mps[i];
      }
    }
    const double mean = sum / count;
    change[hh] = 1 - (later / count - mean * mean) / (same / count - mean * mean);
    fast[hh] = bright_velocity / bright - velocity / count;
    std::printf("%s: power lost from its correlation in 0.3 s %.2f, brightest %.2f %% faster by %.2f m/s\n",
                hh ? "hh" : "vv", change[hh], 100 * bright / count, fast[hh]);
  }
  EXPECT_GT(change[1], 1.5 * change[0]);
  EXPECT_GT(fast[1], 1.3 * fast[0]);
}

TEST(Speckle, OfPhasesHasItsCorrelation) {
  constexpr int kProcesses = 4000;
  IndividualSpeckle speckle(kProcesses, 7);
  std::vector<double> phase(kProcesses);
  std::vector<std::vector<Complex>> values;
  const std::vector<double> times{0, 0.3, 1, 2.5, 40, 40.7};
  for (const double u : times) {
    std::fill(phase.begin(), phase.end(), u);
    for (int k = 0; k < kProcesses; k += 2) phase[k] = 2 * u;  // every other one is twice as fast
    values.emplace_back(kProcesses);
    speckle.at(phase, values.back().data());
  }
  for (std::size_t a = 0; a < times.size(); ++a) {
    for (std::size_t b = a; b < times.size(); ++b) {
      for (const int rate : {1, 2}) {
        Complex sum;
        for (int k = 2 - rate; k < kProcesses; k += 2) sum += values[b][k] * std::conj(values[a][k]);
        const double lag = rate * (times[b] - times[a]);
        EXPECT_NEAR(std::abs(sum / (kProcesses / 2.0) - std::exp(-lag * lag / 2)), 0, 4 / std::sqrt(kProcesses / 2.0));
      }
    }
  }
}

// The same sea at every carrier, of mean power 1.
TEST(ClutterModulatedByTheWaves, IsCoherentAcrossCarriersAndHasMeanPowerOne) {
  RadarSpec radar;
  radar.pulses = 32;
  const PulseTrain train = make_pulse_train(radar, 100, 1, 2);
  double power = 0, square = 0;
  const int intervals = 200;
  for (int i = 1; i <= intervals; ++i) {
    const WaveField waves = realise_sea(sea_towards(0), i, 1);
    ClutterScene scene = scene_of(waves, 2);
    scene.texture_key = i;
    double sum = 0;
    const std::vector<Complex> response = clutter_response(train, by_waves(), scene, 3, i);
    for (const Complex& value : response) sum += std::norm(value);
    sum /= static_cast<double>(response.size());
    power += sum / intervals;
    square += sum * sum / intervals;
  }
  const double error = std::sqrt((square - power * power) / intervals);
  std::printf("mean power %.3f +- %.3f\n", power, error);
  EXPECT_NEAR(power, 1, 4 * error);

  // Two pulses at rest on the first and the second carrier share every frequency of the overlap of their bands.
  radar.hop_code = HopCode::kStepped;
  radar.hop_step_mhz = 12.5;
  radar.pri_us = 100;
  const PulseTrain stepped = make_pulse_train(radar, 100, 1, 2);
  const WaveField calm = realise_sea(sea_towards(0, 0.05), 1, 1);
  ClutterScene low = scene_of(calm, 2);
  low.significant_wave_height_m = 0.05;
  ClutterSpec spec = by_waves();
  spec.doppler_spread_mps = 0;
  const std::vector<Complex> response = clutter_response(stepped, spec, low, 3, 1);
  const std::size_t frequencies = stepped.frequencies();
  double common = 0, apart = 0;
  for (std::size_t b = 0; b + stepped.bins_per_hop < frequencies; ++b) {
    common += std::norm(response[b + stepped.bins_per_hop]);
    apart += std::norm(response[b + stepped.bins_per_hop] - response[frequencies + b]);
  }
  // Motion of 0.3 m/s over 0.1 ms: phase 4 pi 16e9 / c x 3e-5 m = 0.02 rad.
  EXPECT_LT(apart / common, 0.03 * 0.03);
}

}  // namespace
}  // namespace seaglint

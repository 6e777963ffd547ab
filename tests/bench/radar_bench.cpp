// SPDX-License-Identifier: BSD-3-Clause
// The radar chain of one interval of the paper's radar: 60 points, 256 pulses, 40 frequencies per pulse.
#include <benchmark/benchmark.h>

#include <cmath>
#include <ctime>
#include <functional>

#include "classify/features/scattering_centres.h"
#include "radar/rvmap/rv_map.h"
#include "sim/canonical/point_response.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/sea/realisation.h"

namespace seaglint {
namespace {

struct Interval {
  PulseTrain train = make_pulse_train({}, 239.8, 1, 2);
  std::vector<PointSpec> points;
  FrequencyResponse response;
  Echo echo;

  Interval() {
    Random random({1, Stream::kTest, 1});
    for (int i = 0; i < 60; ++i) {
      const double x = -72 + 144 * random.uniform();
      points.push_back({{x, 0, 0}, std::pow(10, -1.5 * random.uniform()), {0.01 * x + 0.1 * random.normal(), 0, 0}});
    }
    response = point_response(points, Vec3(1, 0, 0), interval_sampling(train, 0));
    echo = synthesise_echo(train, response, {}, 1, 1);
  }
};

MapSpec map_with(benchmark::State& state) {
  MapSpec spec;
  spec.velocity_span_mps = static_cast<double>(state.range(0)) * 0.1456;
  return spec;
}

void PulseTrainOfAnInterval(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(make_pulse_train({}, 239.8, 1, 2));
}
BENCHMARK(PulseTrainOfAnInterval)->Unit(benchmark::kMillisecond);

void ResponseOfSixtyPoints(benchmark::State& state) {
  const Interval interval;
  for (auto _ : state) {
    benchmark::DoNotOptimize(point_response(interval.points, Vec3(1, 0, 0), interval_sampling(interval.train, 0)));
  }
}
BENCHMARK(ResponseOfSixtyPoints)->Unit(benchmark::kMillisecond);

void EchoWithClutter(benchmark::State& state) {
  const Interval interval;
  for (auto _ : state) benchmark::DoNotOptimize(synthesise_echo(interval.train, interval.response, {}, 1, 1));
}
BENCHMARK(EchoWithClutter)->Unit(benchmark::kMillisecond);

// Scatterers that move with the waves, their power independent of them (0) or modulated by them (1).
void EchoWithClutterOnTheWaves(benchmark::State& state) {
  const Interval interval;
  SeaState sea;
  sea.order = 1;
  const WaveField waves = realise_sea(sea, 1, 1);
  ClutterScene scene;
  scene.r_hat = Vec3(std::cos(radians(2)), 0, std::sin(radians(2)));
  scene.significant_wave_height_m = sea.significant_wave_height_m;
  scene.waves = &waves;
  ClutterSpec clutter;
  clutter.doppler = ClutterDoppler::kWaveResolved;
  clutter.texture = state.range(0) == 1 ? ClutterTexture::kWaves : ClutterTexture::kIndependent;
  for (auto _ : state)
    benchmark::DoNotOptimize(synthesise_echo(interval.train, interval.response, clutter, 1, 1, scene));
}
BENCHMARK(EchoWithClutterOnTheWaves)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void MapOfVelocities(benchmark::State& state) {
  const Interval interval;
  const MapSpec spec = map_with(state);
  for (auto _ : state) benchmark::DoNotOptimize(form_rv_map(interval.echo.target, interval.train, spec, false));
}
BENCHMARK(MapOfVelocities)->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);

void EchoAndReceivedMap(benchmark::State& state) {
  const Interval interval;
  const MapSpec spec = map_with(state);
  for (auto _ : state) {
    const Echo echo = synthesise_echo(interval.train, interval.response, {}, 1, 1);
    benchmark::DoNotOptimize(form_received_interval(echo, interval.train, {}, spec, false));
  }
}
BENCHMARK(EchoAndReceivedMap)->Arg(64)->Arg(256)->Unit(benchmark::kMillisecond);

// The map at one cell by its definition: the sum over all pulses and frequencies of the echo times matched filter and
// weights, with the phase of a point at this range and velocity removed (radar/rvmap/README.md).
Complex map_by_definition(const Echo& echo, const PulseTrain& train, const MapSpec& spec, double range_m,
                          double velocity_mps) {
  const MapWeights weights = map_weights(train, spec);
  const std::vector<Complex> filter = compression_filter(train, spec.compression);
  Complex sum = 0;
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    for (std::size_t b = 0; b < train.frequencies(); ++b) {
      const double f = train.carrier_hz[n] + train.baseband_hz[b];
      const double phase =
          4 * kPi / kSpeedOfLight * (f * velocity_mps * train.time_s[n] + (f - train.band_centre_hz()) * range_m);
      const std::size_t k = static_cast<std::size_t>(train.code[n]) * train.bins_per_hop + b;
      sum += weights.pulse[n] * weights.bin[k] * filter[b] * echo.target[n * train.frequencies() + b] *
             std::polar(1.0, phase);
    }
  }
  return sum;
}

// The echo of ideal points by its definition, e^{-j 4 pi f R / c} each.
std::vector<Complex> echo_by_definition(const Interval& interval) {
  const PulseTrain& train = interval.train;
  std::vector<Complex> echo;
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    for (std::size_t b = 0; b < train.frequencies(); ++b) {
      const double f = train.carrier_hz[n] + train.baseband_hz[b];
      Complex sum = 0;
      for (const PointSpec& point : interval.points) {
        const double range_m = -(point.position_m[0] + point.velocity_mps[0] * train.time_s[n]);
        sum += point.amplitude_m * std::polar(1.0, -4 * kPi * f * range_m / kSpeedOfLight);
      }
      echo.push_back(train.chirp_spectrum[b] * sum);
    }
  }
  return echo;
}

double seconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// The direct sum is evaluated in every 997th cell of all rows and columns; its time is scaled to the number of cells.
struct Reference {
  double seconds = 0, error_db = 0;
};
Reference reference_map(const Echo& echo, const PulseTrain& train, const MapSpec& spec, const RvMap& map) {
  constexpr std::size_t kStep = 997;
  double error = 0, power = 0;
  std::size_t cells = 0;
  const double spent = seconds([&] {
    for (std::size_t i = 0; i < map.values.size(); i += kStep, ++cells) {
      const Complex exact =
          map_by_definition(echo, train, spec, map.range_m[i % map.columns()], map.velocity_mps[i / map.columns()]);
      error += std::norm(map.values[i] - exact);
      power += std::norm(exact);
    }
  });
  return {spent * static_cast<double>(map.values.size()) / static_cast<double>(cells), 10 * std::log10(error / power)};
}

void report(benchmark::State& state, double solver_s, const Reference& reference) {
  state.counters["definition_s"] = reference.seconds;
  state.counters["definition_over_this"] = reference.seconds / (solver_s / static_cast<double>(state.iterations()));
  state.counters["error_dB"] = reference.error_db;
}

MapSpec map_of_320_by_128() {
  MapSpec spec;
  spec.range_span_m = 239.8;
  spec.velocity_span_mps = 128 * 0.1456;
  return spec;
}

// 256 pulses on 8 carriers, 320 range x 128 velocity cells, compared with the direct sum.
void MapVersusDirectSum(benchmark::State& state) {
  const Interval interval;
  const MapSpec spec = map_of_320_by_128();
  RvMap map;
  double spent = 0;
  for (auto _ : state) {
    spent += seconds([&] { map = form_rv_map(interval.echo.target, interval.train, spec, false); });
  }
  state.counters["cells"] = static_cast<double>(map.values.size());
  report(state, spent, reference_map(interval.echo, interval.train, spec, map));
}
BENCHMARK(MapVersusDirectSum)->Unit(benchmark::kMillisecond);

// 60 points over one interval: response, echo and map without clutter, compared with the direct sums of echo and map.
void SixtyPointsVersusDirectSum(benchmark::State& state) {
  const Interval interval;
  const MapSpec spec = map_of_320_by_128();
  ClutterSpec none;
  none.enabled = false;
  Echo echo;
  RvMap map;
  double spent = 0;
  for (auto _ : state) {
    spent += seconds([&] {
      const FrequencyResponse response =
          point_response(interval.points, Vec3(1, 0, 0), interval_sampling(interval.train, 0));
      echo = synthesise_echo(interval.train, response, none, 1, 1);
      map = form_received_interval(echo, interval.train, none, spec, false).map;
    });
  }
  Echo exact = echo;
  const double echo_s = seconds([&] { exact.target = echo_by_definition(interval); });
  Reference reference = reference_map(exact, interval.train, spec, map);
  reference.seconds += echo_s;
  report(state, spent, reference);
}
BENCHMARK(SixtyPointsVersusDirectSum)->Unit(benchmark::kMillisecond);

void CentresOfSixtyPoints(benchmark::State& state) {
  const Interval interval;
  const std::vector<Complex> echo = interval.echo.total();
  for (auto _ : state) benchmark::DoNotOptimize(clean_map(echo, interval.train, {}, false, {}).centres);
}
BENCHMARK(CentresOfSixtyPoints)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// The radar chain of one interval of the paper's radar: 60 points, 256 pulses, 40 frequencies per pulse.
#include <benchmark/benchmark.h>

#include <cmath>

#include "classify/features/features.h"
#include "radar/rvmap/scr.h"
#include "sim/core/random.h"
#include "sim/scattering/point_response.h"

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
    echo = synthesize_echo(train, response, {}, 1, 1);
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
  for (auto _ : state) benchmark::DoNotOptimize(synthesize_echo(interval.train, interval.response, {}, 1, 1));
}
BENCHMARK(EchoWithClutter)->Unit(benchmark::kMillisecond);

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
    const Echo echo = synthesize_echo(interval.train, interval.response, {}, 1, 1);
    benchmark::DoNotOptimize(receive(echo, interval.train, {}, spec, false));
  }
}
BENCHMARK(EchoAndReceivedMap)->Arg(64)->Arg(256)->Unit(benchmark::kMillisecond);

void CentresOfSixtyPoints(benchmark::State& state) {
  const Interval interval;
  const std::vector<Complex> echo = interval.echo.total();
  for (auto _ : state) benchmark::DoNotOptimize(extract_centres(echo, interval.train, {}, false, {}));
}
BENCHMARK(CentresOfSixtyPoints)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace seaglint

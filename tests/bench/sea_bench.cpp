// SPDX-License-Identifier: BSD-3-Clause
// Run time of the sea surface against the number of components: linear for unidirectional waves in deep water,
// quadratic otherwise.
#include <benchmark/benchmark.h>

#include "sim/sea/realisation.h"
#include "sim/sea/wave_field.h"

namespace seaglint {
namespace {

// All components take part in the second order.
WaveField field_of(int components, Spreading spreading, double depth) {
  SeaState state;
  state.significant_wave_height_m = 1;
  state.peak_period_s = 8;
  state.components = components;
  state.cutoff_rad_s = 4;
  state.second_order_cutoff_rad_s = 4;
  state.spreading.kind = spreading;
  state.depth_m = depth;
  return realise_sea(state, 42, 0);
}

void time_surface(benchmark::State& state, const WaveField& field, SurfaceQuantities detail) {
  double t = 0;
  for (auto _ : state) benchmark::DoNotOptimize(field.surface(3, 4, t += 0.01, detail).elevation);
}

void time_series(benchmark::State& state, const WaveField& field, SurfaceQuantities detail) {
  SurfaceSeries series(field, 3, 4, 0, 0.01, detail);
  for (auto _ : state) {
    benchmark::DoNotOptimize(series.state().elevation);
    series.advance();
  }
}

void LongCrestedAnywhere(benchmark::State& state) {
  const WaveField field = field_of(static_cast<int>(state.range(0)), Spreading::kNone, kDeepWater);
  time_surface(state, field, SurfaceQuantities::kKinematics);
}
BENCHMARK(LongCrestedAnywhere)->RangeMultiplier(2)->Range(64, 4096);

void LongCrestedSeries(benchmark::State& state) {
  const WaveField field = field_of(static_cast<int>(state.range(0)), Spreading::kNone, kDeepWater);
  time_series(state, field, SurfaceQuantities::kElevationAndSlope);
}
BENCHMARK(LongCrestedSeries)->RangeMultiplier(2)->Range(64, 4096);

void LongCrestedMotion(benchmark::State& state) {
  const WaveField field = field_of(static_cast<int>(state.range(0)), Spreading::kNone, kDeepWater);
  time_series(state, field, SurfaceQuantities::kKinematics);
}
BENCHMARK(LongCrestedMotion)->RangeMultiplier(2)->Range(64, 4096);

void DirectionalSeries(benchmark::State& state) {
  const WaveField field = field_of(static_cast<int>(state.range(0)), Spreading::kCos2s, kDeepWater);
  time_series(state, field, SurfaceQuantities::kElevationAndSlope);
}
BENCHMARK(DirectionalSeries)->RangeMultiplier(2)->Range(64, 1024);

void DirectionalMotion(benchmark::State& state) {
  const WaveField field = field_of(static_cast<int>(state.range(0)), Spreading::kCos2s, 20);
  time_series(state, field, SurfaceQuantities::kKinematics);
}
BENCHMARK(DirectionalMotion)->RangeMultiplier(2)->Range(64, 1024);

void RealiseSea(benchmark::State& state) {
  const auto spreading = static_cast<Spreading>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(field_of(512, spreading, kDeepWater).order());
}
BENCHMARK(RealiseSea)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace seaglint

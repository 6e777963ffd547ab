// SPDX-License-Identifier: BSD-3-Clause
// Run time of the solver on the 144 m ship and the 1 m reflector, compared with Embree alone on primary rays.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/scatterer/embree_scene.h"
#include "tests/bench/ship.h"
#include "tests/sim/scattering/solve_calls.h"

namespace seaglint {
namespace {

const RayScene& ship_rays() {
  static const RayScene scene(ship().facets());
  return scene;
}

// Primary rays 0.1 m apart over the ship's extent in the projection plane.
std::vector<Ray> primary_rays(const RadarBasis& basis) {
  std::vector<Ray> rays;
  const auto [lower, upper] = window_of(ship(), basis);
  for (double y = lower.y(); y < upper.y(); y += 0.1) {
    for (double x = lower.x(); x < upper.x(); x += 0.1)
      rays.push_back({x * basis.h + y * basis.v + 75 * basis.r, -basis.r});
  }
  return rays;
}

// Embree alone, packets of 16.
void EmbreeFirstHitsOnShip(benchmark::State& state) {
  const std::vector<Ray> rays = primary_rays(radar_basis(direction(static_cast<double>(state.range(0)))));
  std::vector<int> hits(rays.size());
  for (auto _ : state) ship_rays().first_hits(rays, hits);
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(rays.size() * state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(EmbreeFirstHitsOnShip)->Arg(10)->Arg(50)->Arg(90)->Unit(benchmark::kMillisecond);

// One trace and the response over the whole band and interval from it, on two threads; for comparison Embree alone,
// first hits of primary rays 0.1 m apart, in processor time of the same run.
void ShipInterval(benchmark::State& state) {
  const Trajectory trajectory = rolling(0.005, {0, 0, 1.7});
  const Vec3 r = direction(static_cast<double>(state.range(0)));
  const std::vector<Ray> rays = primary_rays(radar_basis(r));
  std::vector<int> hits(rays.size());
  ship_rays().first_hits(rays, hits);
  const double embree = processor_seconds([&] { ship_rays().first_hits(rays, hits); });
  double solver = 0;
  for (auto _ : state) {
    solver += processor_seconds([&] {
      benchmark::DoNotOptimize(interval_response(ship(), trajectory, r, Polarisation::kVv, paper_interval(), {}, 2));
    });
  }
  solver /= static_cast<double>(state.iterations());
  state.counters["processor_s"] = solver;
  state.counters["over_embree"] = solver / embree;
}
BENCHMARK(ShipInterval)->Arg(10)->Arg(50)->Arg(90)->Arg(130)->Unit(benchmark::kMillisecond)->UseRealTime();

// At the roll rate of Hs 2 m, Tp 8 s, with the number of aspect traces that the aspect change needs.
void ShipIntervalRollingAtOneRms(benchmark::State& state) {
  const Trajectory trajectory = rolling(0.014, {0, 0, 1.7});
  const Vec3 r = direction(static_cast<double>(state.range(0)));
  int traces = 0;
  for (auto _ : state)
    traces = interval_response(ship(), trajectory, r, Polarisation::kVv, paper_interval(), {}, 2).traces;
  state.counters["traces"] = traces;
}
BENCHMARK(ShipIntervalRollingAtOneRms)->Arg(50)->Arg(90)->Unit(benchmark::kMillisecond)->UseRealTime();

// A float tilting by 2.2 deg in the interval, one thread.
void ReflectorInterval(benchmark::State& state) {
  const Scatterer reflector(make_icosahedral_reflector());
  const Trajectory trajectory = rolling(0.6, {0, 0, -0.75});
  int traces = 0;
  for (auto _ : state)
    traces = interval_response(reflector, trajectory, direction(80), Polarisation::kVv, paper_interval(), {}).traces;
  state.counters["traces"] = traces;
}
BENCHMARK(ReflectorInterval)->Unit(benchmark::kMillisecond)->UseRealTime();

// This many frequencies of 200 MHz about 16 GHz.
std::vector<double> frequency_sweep(int count) {
  std::vector<double> k;
  for (int q = 0; q < count; ++q) k.push_back(2 * kPi * (16e9 + 200e6 * ((q + 0.5) / count - 0.5)) / kSpeedOfLight);
  return k;
}

// One aspect of a sweep.
void ShipAspect(benchmark::State& state) {
  const RadarBasis basis = radar_basis(direction(static_cast<double>(state.range(0))));
  const std::vector<double> k = frequency_sweep(static_cast<int>(state.range(1)));
  std::size_t segments = 0;
  for (auto _ : state) {
    const BistaticGeometry view = monostatic(basis);
    const SolveResult solved = solve(views_request(ship(), std::span(&view, 1), k, {}, 2));
    benchmark::DoNotOptimize(solved.views.data());
    segments += solved.segments;
  }
  state.counters["segments/s"] = benchmark::Counter(static_cast<double>(segments), benchmark::Counter::kIsRate);
}
BENCHMARK(ShipAspect)->Args({50, 1})->Args({50, 16})->Unit(benchmark::kMillisecond)->UseRealTime();

// Processor time of 150 frequencies of one aspect over that of one frequency, alternating in one run on one thread,
// edge diffraction on.
void ShipSweepOverOneFrequency(benchmark::State& state) {
  const RadarBasis basis = radar_basis(direction(static_cast<double>(state.range(0))));
  const std::vector<double> one = frequency_sweep(1), many = frequency_sweep(150);
  const TracingSettings settings{0, kDefaultBounces, true};
  double of_one = 0, of_many = 0;
  for (auto _ : state) {
    of_one += processor_seconds(
        [&] { benchmark::DoNotOptimize(scattering_matrices(ship(), monostatic(basis), one, settings, 1)); });
    of_many += processor_seconds(
        [&] { benchmark::DoNotOptimize(scattering_matrices(ship(), monostatic(basis), many, settings, 1)); });
  }
  state.counters["ratio"] = of_many / of_one;
}
BENCHMARK(ShipSweepOverOneFrequency)->Arg(10)->Arg(50)->Arg(90)->Unit(benchmark::kMillisecond);

// Run time of the solver over that of Embree on primary rays 0.1 m apart, alternating in one run on one thread each.
// The solver traces no rays; its beams include every bounce, the primary rays only the first.
void SolverTimeOverEmbreeFirstHits(benchmark::State& state) {
  const RadarBasis basis = radar_basis(direction(static_cast<double>(state.range(0))));
  const std::vector<Ray> rays = primary_rays(basis);
  std::vector<int> hits(rays.size());
  const std::vector<double> k(1, 2 * kPi * 16e9 / kSpeedOfLight);
  std::clock_t solver = 0, embree = 0;
  for (auto _ : state) {
    const std::clock_t start = std::clock();
    benchmark::DoNotOptimize(scattering_matrices(ship(), monostatic(basis), k, {}, 1));
    const std::clock_t middle = std::clock();
    ship_rays().first_hits(rays, hits);
    benchmark::DoNotOptimize(hits.data());
    solver += middle - start;
    embree += std::clock() - middle;
  }
  state.counters["ratio"] = static_cast<double>(solver) / static_cast<double>(embree);
  state.counters["ns/ray"] =
      1e9 * static_cast<double>(solver) / CLOCKS_PER_SEC / static_cast<double>(rays.size() * state.iterations());
}
BENCHMARK(SolverTimeOverEmbreeFirstHits)->Arg(10)->Arg(50)->Arg(90)->Unit(benchmark::kMillisecond);

// Run time against the ship's length in metres.
void ShipLength(benchmark::State& state) {
  TriangleMesh mesh = read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb");
  for (Vec3& x : mesh.vertices) x *= static_cast<double>(state.range(0)) / 144;
  const Scatterer scaled(mesh);
  const RadarBasis basis = radar_basis(direction(50));
  const std::vector<double> k(1, 2 * kPi * 16e9 / kSpeedOfLight);
  for (auto _ : state) benchmark::DoNotOptimize(scattering_matrices(scaled, monostatic(basis), k, {}, 1));
}
BENCHMARK(ShipLength)->Arg(36)->Arg(72)->Arg(144)->Arg(288)->Unit(benchmark::kMillisecond);

// Run time for a body at rest and one pulse against the carrier in GHz and the number of frequencies.
void ShipBand(benchmark::State& state) {
  IntervalSampling sampling;
  sampling.step_hz = 0.3125e6;
  sampling.first_hz = 1e9 * static_cast<double>(state.range(0));
  sampling.count = sampling.frequencies_per_pulse = static_cast<int>(state.range(1));
  sampling.pulse_first.push_back(0);
  sampling.pulse_time_s.push_back(0);
  const Trajectory rest = Trajectory::at_rest(Vec3::Zero());
  for (auto _ : state)
    benchmark::DoNotOptimize(interval_response(ship(), rest, direction(50), Polarisation::kVv, sampling, {}, 1));
}
BENCHMARK(ShipBand)
    ->ArgsProduct({{1, 2, 4, 8, 16, 32}, {320}})
    ->ArgsProduct({{16}, {1, 16, 160, 640}})
    ->Unit(benchmark::kMillisecond);

// Relative L2 error of the default settings against patches of a five-thousandth of the area, over 24 frequencies of
// 200 MHz, hh and vv.
void ShipDefaultSettingsError(benchmark::State& state) {
  const RadarBasis basis = radar_basis(direction(static_cast<double>(state.range(0))));
  std::vector<double> k;
  for (int q = 0; q < 24; ++q) k.push_back(2 * kPi * (16e9 + 200e6 * q / 24) / kSpeedOfLight);
  const auto finest = scattering_matrices(ship(), monostatic(basis), k, {7e-5, 64}, 2);
  double error = 0, power = 0;
  for (auto _ : state) {
    const auto usual = scattering_matrices(ship(), monostatic(basis), k, {}, 2);
    for (std::size_t q = 0; q < k.size(); ++q) {
      for (const int channel : {0, 3}) {
        error += std::norm(usual[q][channel] - finest[q][channel]);
        power += std::norm(finest[q][channel]);
      }
    }
  }
  state.counters["error_dB"] = 10 * std::log10(error / power);
}
BENCHMARK(ShipDefaultSettingsError)
    ->Arg(10)
    ->Arg(50)
    ->Arg(80)
    ->Arg(130)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

// A sphere of 1.3 million facets; reports the maximum resident memory of the process so far.
void MillionFacets(benchmark::State& state) {
  const Scatterer sphere(make_sphere(10, 8));
  const std::vector<double> k(1, 2 * kPi * 1e9 * static_cast<double>(state.range(0)) / kSpeedOfLight);
  for (auto _ : state)
    benchmark::DoNotOptimize(scattering_matrices(sphere, monostatic(radar_basis(direction(50))), k, {}, 2));
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  state.counters["facets"] = static_cast<double>(sphere.facets().size());
  state.counters["peak_MB"] = 1e-3 * static_cast<double>(usage.ru_maxrss);
}
BENCHMARK(MillionFacets)->Arg(16)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

}  // namespace
}  // namespace seaglint

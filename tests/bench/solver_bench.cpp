// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <ctime>
#include <iterator>
#include <memory>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/ship/make_ship.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/points/phase_integral.h"
#include "sim/scattering/scatterer/embree_scene.h"
#include "sim/scattering/scatterer/prepare_target.h"
#include "sim/scattering/solver/solve.h"
#include "sim/scattering/tracing/interaction.h"
#include "sim/scattering/tracing/ray_tracer.h"
#include "tests/sim/scattering/solve_calls.h"

namespace seaglint {
namespace {

// The ship, the look directions and the interval that the benchmarks of the solver have in common.

// Look direction of the radar, elevation 2 deg.
Vec3 direction(double azimuth_deg) { return direction_to_radar(radians(azimuth_deg), radians(2)); }

const Scatterer& ship() {
  static const PreparedTarget target = [] {
    TargetSource source;
    source.mesh = SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb";
    return prepare_target(load_target_mesh(source), {});
  }();
  return *target.scatterer;
}

// Extent of the target in the projection plane.
Box window_of(const Scatterer& scatterer, const RadarBasis& basis) {
  Box window{Vec2::Constant(1e9), Vec2::Constant(-1e9)};
  for (const Facet& facet : scatterer.facets()) {
    for (const Vec3& x : facet.corner) {
      const Vec2 p(x.dot(basis.h), x.dot(basis.v));
      window = {window.lower.cwiseMin(p), window.upper.cwiseMax(p)};
    }
  }
  return window;
}

// The paper's interval: 256 pulses of 25 MHz, 320 frequencies.
IntervalSampling paper_interval() {
  IntervalSampling sampling;
  sampling.step_hz = 0.625e6;
  sampling.first_hz = 16e9 - 12.5e6 + 0.5 * sampling.step_hz;
  sampling.count = 320;
  sampling.frequencies_per_pulse = 40;
  for (int n = 0; n < 256; ++n) {
    sampling.pulse_first.push_back(40 * (n * 5 % 8));
    sampling.pulse_time_s.push_back(0.5 + 250e-6 * n);
  }
  return sampling;
}

// Roll with the given rate, rad/s.
Trajectory rolling(double rate, const Vec3& centre) {
  std::vector<MotionSample> samples(101);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].angles.x() = rate * 0.01 * static_cast<double>(i);
    samples[i].angle_rates.x() = rate;
  }
  return Trajectory(0, 0.01, samples, Vec3::Zero(), centre);
}

// Processor time of all threads, s.
template <typename Work>
double processor_seconds(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// Run time of the solver on the 144 m ship and the 1 m reflector, compared with Embree alone on primary rays.

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

// Processor time of the interval of a generated ship over that of the combatant, mean over six azimuths, alternating
// on one thread. Arguments: kind, seed.
void FleetIntervalOverCombatant(benchmark::State& state) {
  ShipSpec spec;
  spec.kind = static_cast<ShipKind>(state.range(0));
  spec.seed = static_cast<std::uint64_t>(state.range(1));
  TargetSource source;
  source.loaded = std::make_shared<const TriangleMesh>(make_ship(spec).mesh);
  ScattererSettings settings;
  settings.waterline_m = 0;
  const PreparedTarget target = prepare_target(load_target_mesh(source), settings);
  const Trajectory trajectory = rolling(0.005, {0, 0, 1.7});
  const auto interval = [&](const Scatterer& scatterer, double azimuth_deg) {
    return processor_seconds([&] {
      benchmark::DoNotOptimize(
          interval_response(scatterer, trajectory, direction(azimuth_deg), Polarisation::kVv, paper_interval(), {}, 1));
    });
  };
  double of_kind = 0, of_combatant = 0;
  for (auto _ : state) {
    for (int azimuth_deg = 5; azimuth_deg < 180; azimuth_deg += 34) {
      of_kind += interval(*target.scatterer, azimuth_deg);
      of_combatant += interval(ship(), azimuth_deg);
    }
  }
  state.SetLabel(kShipKindNames[state.range(0)]);
  state.counters["triangles"] = static_cast<double>(target.mesh.triangles.size());
  state.counters["ratio"] = of_kind / of_combatant;
}
BENCHMARK(FleetIntervalOverCombatant)
    ->ArgsProduct({benchmark::CreateDenseRange(0, std::size(kShipKindNames) - 1, 1), {0, 1}})
    ->Unit(benchmark::kSecond)
    ->Iterations(1);

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

// Shooting and bouncing rays with Embree compared with beam tracing: error and run time of both on the 144 m ship.

// Flat facets for both solvers.
const Scatterer& flat_ship() {
  static const Scatterer scatterer(read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb"), {}, 0);
  return scatterer;
}

// Wavenumbers over 200 MHz.
std::vector<double> band(int count = 6) {
  std::vector<double> k;
  for (int q = 0; q < count; ++q) k.push_back(2 * kPi * (16e9 + 200e6 * q / count) / kSpeedOfLight);
  return k;
}

double relative_error_db(const Matrices& S, const Matrices& exact) {
  double error = 0, power = 0;
  for (std::size_t q = 0; q < S.size(); ++q) {
    for (const int channel : {0, 3}) {
      error += std::norm(S[q][channel] - exact[q][channel]);
      power += std::norm(exact[q][channel]);
    }
  }
  return 10 * std::log10(error / power);
}

// Shooting and bouncing rays: one ray tube per square of the projection plane, with physical optics at every bounce
// that is visible to the radar and the closed-form phase integral over the tube's footprint. Everything is in double
// precision except Embree's queries, which return facet numbers.
class RaySolver {
 public:
  RaySolver(const Scatterer& scatterer, const RadarBasis& basis, double side)
      : scatterer_(scatterer), scene_(scatterer.facets()), geometry_(monostatic(basis)), side_(side) {}

  Matrices solve(std::span<const double> k) {
    const RadarBasis& basis = geometry_.transmit;
    const auto [lower, upper] = window_of(scatterer_, basis);
    Matrices sum(k.size());
    // Tiles of rays: packets of adjacent rays.
    constexpr int kTile = 64;
    const double tile = kTile * side_;
    for (double y = lower.y(); y < upper.y(); y += tile) {
      for (double x = lower.x(); x < upper.x(); x += tile) {
        std::vector<Tube> tubes;
        for (int i = 0; i < kTile * kTile; ++i) {
          const int row = i / kTile, column = i % kTile;
          const Vec2 p(x + (column + 0.5) * side_, y + (row + 0.5) * side_);
          Tube& tube = tubes.emplace_back();
          tube.p = p;
          tube.ray = {p.x() * basis.h + p.y() * basis.v + 2 * scatterer_.radius() * basis.r, -basis.r};
          tube.segment.direction = -basis.r;
          tube.segment.E_h = basis.h;
          tube.segment.E_v = basis.v;
        }
        follow(tubes, k, sum);
      }
    }
    return sum;
  }

  double embree_seconds() const { return static_cast<double>(embree_) / CLOCKS_PER_SEC; }
  std::size_t rays() const { return rays_; }

 private:
  struct Tube {
    Vec2 p;  // in the projection plane
    Ray ray;
    BeamSegment segment;
  };

  std::vector<int> first_hits(const std::vector<Ray>& rays) {
    std::vector<int> hits(rays.size());
    const std::clock_t start = std::clock();
    scene_.first_hits(rays, hits);
    embree_ += std::clock() - start;
    rays_ += rays.size();
    return hits;
  }

  void follow(std::vector<Tube>& tubes, std::span<const double> k, Matrices& sum) {
    constexpr double kOffSurface = 1e-4;  // m
    for (int bounce = 1; bounce <= kDefaultBounces && !tubes.empty(); ++bounce) {
      std::vector<Ray> rays;
      for (const Tube& tube : tubes) rays.push_back(tube.ray);
      const std::vector<int> hits = first_hits(rays);
      std::vector<Tube> reflected;
      std::vector<Contribution> contributions;
      std::vector<Ray> to_radar;
      for (std::size_t i = 0; i < tubes.size(); ++i) {
        if (hits[i] == kNoFacet) continue;
        Tube tube = tubes[i];
        const Facet& facet = scatterer_.facets()[hits[i]];
        const Vec3 n = illuminated_normal(tube.segment, facet);
        const double cosine = -n.dot(tube.segment.direction);
        if (cosine < 1e-6 || (!facet.two_sided && facet.normal.dot(tube.segment.direction) > 0)) continue;
        const double distance = n.dot(facet.corner[0] - tube.ray.origin) / n.dot(tube.segment.direction);
        const Vec3 hit = tube.ray.origin + distance * tube.segment.direction + kOffSurface * n;
        if (n.dot(geometry_.receive.r) > 1e-6) {
          contributions.push_back(contribution(tube, facet, n, cosine));
          to_radar.push_back({hit, geometry_.receive.r});
        }
        tube.segment.image_transform = {
            tube.segment.image_transform.L * (Mat3::Identity() - outer_product(2 * n, n)),
            tube.segment.image_transform.L * (2 * n.dot(facet.corner[0]) * n) + tube.segment.image_transform.t};
        tube.segment.direction += 2 * cosine * n;
        tube.segment.E_h = 2 * n.dot(tube.segment.E_h) * n - tube.segment.E_h;
        tube.segment.E_v = 2 * n.dot(tube.segment.E_v) * n - tube.segment.E_v;
        tube.ray = {hit, tube.segment.direction};
        reflected.push_back(tube);
      }
      // The first hit is visible to the radar.
      const std::vector<int> hidden = bounce == 1 ? std::vector<int>(to_radar.size(), kNoFacet) : first_hits(to_radar);
      for (std::size_t i = 0; i < contributions.size(); ++i) {
        if (hidden[i] != kNoFacet) continue;
        for (std::size_t q = 0; q < k.size(); ++q) {
          const std::array<Complex, 4> s = scattered(contributions[i], geometry_, k[q]);
          for (int c = 0; c < 4; ++c) sum[q][c] += s[c];
        }
      }
      tubes = std::move(reflected);
    }
  }

  Contribution contribution(const Tube& tube, const Facet& facet, const Vec3& n, double cosine) const {
    Footprint footprint;
    footprint.image_transform = tube.segment.image_transform;
    const Vec3 n_image = tube.segment.image_transform.L * facet.normal;
    footprint.plane =
        depth_plane(n_image, n_image.dot(tube.segment.image_transform.image(facet.corner[0])), geometry_.transmit);
    set_phase(footprint, n_image, geometry_);
    const double half = side_ / 2;
    for (const Vec2& corner : {Vec2(-half, -half), Vec2(half, -half), Vec2(half, half), Vec2(-half, half)})
      footprint.polygon.push_back({tube.p + corner, Vec2::Zero(), Vec2::Zero()});
    return {{pec_pattern(tube.segment, n, cosine, geometry_.receive)}, {}, footprint};
  }

  const Scatterer& scatterer_;
  RayScene scene_;
  BistaticGeometry geometry_;
  double side_;  // m
  std::clock_t embree_ = 0;
  std::size_t rays_ = 0;
};

template <typename Seconds>
double fastest_of_three(const Seconds& seconds) {
  return std::min({seconds(), seconds(), seconds()});
}

// All rays of the method of rays from one direction, without tubes, and Embree's part of that time.
struct SearchTime {
  double all_s = 0, embree_s = 0;
  std::size_t queries = 0;
};
SearchTime time_of_search(const Scatterer& scatterer, const RadarBasis& basis, const TracingSettings& settings) {
  const RayLattice lattice(scatterer, basis, ray_spacing(scatterer, settings));
  const Aspect aspect(scatterer, basis, settings, 1);
  const std::vector<Receiver> receivers{{monostatic(basis), aspect.visible}};
  const TracingContext scene{
      scatterer, basis, receivers, settings, aspect.visible, {}, SmallestAreas(scatterer, settings)};
  SearchTime search;
  search.all_s = fastest_of_three([&] {
    RayPaths paths(scene);
    RayRefinement refinement(lattice, paths);
    const double seconds = processor_seconds([&] {
      for (std::size_t tile = 0; tile < lattice.tiles(); ++tile) refinement.trace(tile);
    });
    search.queries = paths.queries();
    search.embree_s = search.embree_s > 0 ? std::min(search.embree_s, paths.embree_seconds()) : paths.embree_seconds();
    return seconds;
  });
  return search;
}

// Azimuth in degrees, side of a tube in mm; 18 mm is the side of the smallest beam that is reflected further. embree_s
// is the time of Embree's queries alone, for every bounce and from each hit after the first towards the radar. For
// comparison the beam tracer on one thread: a matrix without edges, which is what the rays compute, and the default
// with edges for all 256 pulses and 320 frequencies of an interval. Every time is the fastest of three runs, since the
// first run also allocates memory. Errors are relative to beams with patches of 1 mm.
void ShipSbrReference(benchmark::State& state) {
  const Vec3 r = direction(static_cast<double>(state.range(0)));
  const RadarBasis basis = radar_basis(r);
  const std::vector<double> k = band(), one(1, k.front());
  const Matrices exact = scattering_matrices(flat_ship(), monostatic(basis), k, {1e-3, kDefaultBounces}, 2);
  const Matrices by_beams = scattering_matrices(flat_ship(), monostatic(basis), k, {0, kDefaultBounces}, 2);
  const Trajectory trajectory = rolling(0.005, {0, 0, 1.7});
  for (auto _ : state) {
    Matrices by_rays;
    std::size_t traced = 0;
    const double embree = fastest_of_three([&] {
      RaySolver rays(flat_ship(), basis, 1e-3 * static_cast<double>(state.range(1)));
      by_rays = rays.solve(k);
      traced = rays.rays();
      return rays.embree_seconds();
    });
    const double matrix = fastest_of_three([&] {
      return processor_seconds([&] {
        benchmark::DoNotOptimize(scattering_matrices(flat_ship(), monostatic(basis), one, {0, kDefaultBounces}, 1));
      });
    });
    const double interval = fastest_of_three([&] {
      return processor_seconds([&] {
        benchmark::DoNotOptimize(interval_response(ship(), trajectory, r, Polarisation::kVv, paper_interval(), {}, 1));
      });
    });
    state.counters["rays_dB"] = relative_error_db(by_rays, exact);
    state.counters["beams_dB"] = relative_error_db(by_beams, exact);
    state.counters["Mrays"] = 1e-6 * static_cast<double>(traced);
    state.counters["embree_s"] = embree;
    state.counters["matrix/embree"] = matrix / embree;
    state.counters["interval/embree"] = interval / embree;
  }
}
BENCHMARK(ShipSbrReference)
    ->ArgsProduct({{10, 50, 90}, {100, 50, 18, 10}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

// The method of rays on the ship with edges, at its default distance between rays and at a multiple of it in percent:
// error against beams with patches of 1 mm over six frequencies of 200 MHz, and processor time over that of the beams
// by default and over that of Embree's queries on the same rays, one thread, each the fastest of three runs. matrix: of
// 16 frequencies without edges; search: the rays without tubes.
void ShipByRays(benchmark::State& state) {
  const RadarBasis basis = radar_basis(direction(static_cast<double>(state.range(0))));
  const BistaticGeometry geometry = monostatic(basis);
  const std::vector<double> k = band();
  TracingSettings settings{0, kDefaultBounces, true, {}, SolverMethod::kRays};
  settings.ray_spacing_m = 0.01 * static_cast<double>(state.range(1)) * ray_spacing(ship());
  const Matrices exact = scattering_matrices(ship(), geometry, k, {1e-3, kDefaultBounces, true}, 2);
  Matrices by_rays;
  for (auto _ : state) {
    const auto seconds_of = [&](const TracingSettings& of, Matrices& result) {
      return fastest_of_three(
          [&] { return processor_seconds([&] { result = scattering_matrices(ship(), geometry, k, of, 1); }); });
    };
    Matrices by_beams;
    const double rays_s = seconds_of(settings, by_rays), beams_s = seconds_of({0, kDefaultBounces, true}, by_beams);
    state.counters["rays_dB"] = relative_error_db(by_rays, exact);
    state.counters["beams_dB"] = relative_error_db(by_beams, exact);
    state.counters["rays/beams"] = rays_s / beams_s;
    const SearchTime search = time_of_search(ship(), basis, settings);
    state.counters["Mrays"] = 1e-6 * static_cast<double>(search.queries);
    state.counters["rays/embree"] = rays_s / search.embree_s;
    state.counters["search/embree"] = search.all_s / search.embree_s;
    TracingSettings without_edges = settings;
    without_edges.edges = false;
    const std::vector<double> sixteen = band(16);
    const double matrix_s = fastest_of_three([&] {
      return processor_seconds(
          [&] { benchmark::DoNotOptimize(scattering_matrices(ship(), geometry, sixteen, without_edges, 1)); });
    });
    state.counters["matrix/embree"] = matrix_s / search.embree_s;
  }
}
BENCHMARK(ShipByRays)->ArgsProduct({{10, 50, 90}, {100, 300}})->Unit(benchmark::kMillisecond)->Iterations(1);

// A sphere of radius 0.5 m cut into 20 x 4^n triangles, merged as the program does at 10 GHz: processor time by rays,
// and over that by beams. From one row to the next there are 16 times as many triangles.
void SphereByRays(benchmark::State& state) {
  const Scatterer sphere(make_sphere(0.5, static_cast<int>(state.range(0))), {}, std::nullopt, 0,
                         merging_tolerance(10e9));
  const BistaticGeometry geometry = monostatic(radar_basis(direction(10)));
  const std::vector<double> k{2 * kPi * 10e9 / kSpeedOfLight};
  const auto seconds_by = [&](SolverMethod method) {
    const TracingSettings settings{0, kDefaultBounces, false, {}, method};
    return fastest_of_three([&] {
      return processor_seconds(
          [&] { benchmark::DoNotOptimize(scattering_matrices(sphere, geometry, k, settings, 1)); });
    });
  };
  for (auto _ : state) {
    const double rays_s = seconds_by(SolverMethod::kRays);
    state.counters["facets"] = static_cast<double>(sphere.facets().size());
    state.counters["rays_s"] = rays_s;
    state.counters["rays/beams"] = rays_s / seconds_by(SolverMethod::kBeams);
  }
}
BENCHMARK(SphereByRays)->Arg(3)->Arg(5)->Arg(7)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace seaglint

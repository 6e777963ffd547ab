// SPDX-License-Identifier: BSD-3-Clause
// Traces that intervals share: the lattice of directions, which intervals share one, and what is kept.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "sim/core/numbers/random.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/solver/shared_traces.h"
#include "tests/relative_difference.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

Vec3 random_direction(Random& random) { return Vec3(random.normal(), random.normal(), random.normal()).normalized(); }

TEST(DirectionLattice, InterpolatesBetweenDirectionsAround) {
  for (const double step : {0.05, 5e-4}) {
    const DirectionLattice lattice(step);
    Random random({3, Stream::kTest, 0});
    for (int i = 0; i < 20000; ++i) {
      Vec3 direction = random_direction(random);
      if (i % 10 == 0) direction = (direction + Vec3(0, 0, i % 20 ? 30.0 : -30.0)).normalized();
      const bool near_pole = std::abs(direction.z()) > 0.95;
      const double steepness = std::abs(direction.z()) / std::hypot(direction.x(), direction.y());  // tan(elevation)
      double sum = 0;
      Vec3 mean = Vec3::Zero();
      for (const auto& [at, weight] : lattice.around(direction)) {
        EXPECT_GE(weight, 0);
        sum += weight;
        mean += weight * lattice.vector(at);
        // The diagonal of a cell; azimuths of the upper circle are farther apart on a lower one.
        EXPECT_LT((lattice.vector(at) - direction).norm(),
                  (near_pole ? 2 : std::sqrt(2) * (1 + steepness * step)) * step)
            << step << " " << i;
      }
      EXPECT_NEAR(sum, 1, 1e-12);
      // The error of linear interpolation, step^2 / 8 for each of both coordinates; of the longitude the curvature is
      // tan(elevation) times that of a great circle.
      if (!near_pole) {
        EXPECT_LT((mean - direction).norm(), step * step / 8 * (2 + steepness)) << step << " " << i;
      }
    }
  }
}

TEST(DirectionLattice, HasOneDirectionOnBothSidesOf180Degrees) {
  const DirectionLattice lattice(0.01);
  const auto port = lattice.around(Vec3(-1, 1e-9, 0.123).normalized());
  const auto starboard = lattice.around(Vec3(-1, -1e-9, 0.123).normalized());
  const auto weight_of = [](const auto& weighted, const LatticeDirection& direction) {
    double sum = 0;
    for (const auto& [at, weight] : weighted) sum += at == direction ? weight : 0;
    return sum;
  };
  for (const auto& [at, weight] : port) EXPECT_NEAR(weight_of(starboard, at), weight, 1e-5);
}

// A body at rest at an attitude (roll, pitch, yaw).
Trajectory tilted(const Vec3& angles) {
  MotionSample sample;
  sample.angles = angles;
  return Trajectory(0, 1, std::vector<MotionSample>(8, sample), Vec3::Zero(), Vec3::Zero());
}

SolverSpec sharing() {
  SolverSpec solver;
  solver.shared_traces = true;
  return solver;
}

std::vector<Complex> values_of(const Scatterer& body, const Trajectory& trajectory, Polarisation polarisation,
                               const SolverSpec& solver, SharedTraces* shared, int threads = 1) {
  return body_response(body, trajectory, direction(40, 10), polarisation, paper_interval(0.3), solver, threads, nullptr,
                       nullptr, shared)
      .response.values;
}

TEST(SharedTraces, GiveTheSameValuesWhateverIsKept) {
  const Scatterer body(make_icosahedral_reflector());
  const auto memory = std::make_shared<TraceMemory>();
  const auto full = std::make_shared<TraceMemory>();
  full->free_bytes = 1000;  // less than one trace
  SharedTraces kept(memory), dropped(full);
  const std::int64_t all_bytes = memory->free_bytes;
  for (const double pitch : {0.0, 2e-4, -3e-4, 2e-4}) {
    const Trajectory trajectory = tilted({0, pitch, 0});
    const auto alone = values_of(body, trajectory, Polarisation::kVv, sharing(), nullptr);
    EXPECT_EQ(values_of(body, trajectory, Polarisation::kVv, sharing(), &kept), alone) << pitch;
    EXPECT_EQ(values_of(body, trajectory, Polarisation::kVv, sharing(), &dropped, 3), alone) << pitch;
  }
  EXPECT_EQ(full->free_bytes, 1000);
  EXPECT_LT(memory->free_bytes, all_bytes);
}

TEST(SharedTraces, AreMadeOncePerDirectionFromAnyThread) {
  const auto memory = std::make_shared<TraceMemory>();
  {
    SharedTraces traces(memory);
    std::atomic<int> made = 0;
    const auto make = [&] {
      ++made;
      return SharedTrace{RadarBasis{}, std::vector<SharedTrace::Point>(10)};
    };
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i) threads.emplace_back([&, i] { traces.get({{i % 2, 0}, 300, 2, 3}, make); });
    threads.clear();
    EXPECT_EQ(made, 2);
    EXPECT_THROW(traces.get({{5, 0}, 300, 2, 3}, []() -> SharedTrace { throw std::runtime_error("stopped"); }),
                 std::runtime_error);
    traces.get({{5, 0}, 300, 2, 3}, make);  // made although it failed before
    EXPECT_EQ(made, 3);
  }
  EXPECT_EQ(memory->free_bytes, TraceMemory{}.free_bytes) << "the memory of traces that are gone is free again";
}

// A twist of the polarisation basis beyond 0.15 deg, crossed polarisations and fast intervals are traced on their own.
TEST(SharedTraces, LeaveOtherIntervalsAsTheyAre) {
  const Scatterer body(make_icosahedral_reflector());
  const auto expect_own = [&](const Trajectory& trajectory, Polarisation polarisation, const SolverSpec& solver) {
    SolverSpec own = solver;
    own.shared_traces = false;
    EXPECT_EQ(values_of(body, trajectory, polarisation, solver, nullptr),
              values_of(body, trajectory, polarisation, own, nullptr));
  };
  const Vec3 r_hat = direction(40, 10);
  // By 0.3 deg about the line of sight.
  expect_own(tilted(0.3 * kPi / 180 * r_hat), Polarisation::kVv, sharing());
  expect_own(tilted({0, 1e-4, 0}), Polarisation::kHv, sharing());
  SolverSpec near = sharing();
  near.wavefront_range_m = 1000;
  expect_own(tilted({0, 1e-4, 0}), Polarisation::kVv, near);
  MotionSample fast;
  fast.angle_rates = Vec3(0, 0.05, 0);
  std::vector<MotionSample> samples;
  for (int i = 0; i < 8; ++i, fast.angles.y() += 0.05) samples.push_back(fast);  // 3.2 mrad in the interval
  expect_own(Trajectory(0, 1, samples, Vec3::Zero(), Vec3::Zero()), Polarisation::kVv, sharing());
}

// Four traces at most 2.6 mrad away, each moved by its path gradients, against one of the interval's own direction: the
// amplitudes of both are frozen, and linear interpolation over a cell of 1.8 mrad leaves their second order.
TEST(SharedTraces, MatchTracesOfTheIntervalsOwnDirection) {
  const Scatterer body(make_icosahedral_reflector());
  Random random({3, Stream::kTest, 2});
  double mean_square = 0;
  int shared = 0;
  for (int i = 0; i < 20; ++i) {
    const Trajectory trajectory = tilted(1e-3 * Vec3(random.normal(), random.normal(), random.normal()));
    const double error = relative_difference(values_of(body, trajectory, Polarisation::kHh, sharing(), nullptr),
                                             values_of(body, trajectory, Polarisation::kHh, SolverSpec{}, nullptr));
    if (error == 0) continue;
    ++shared;
    mean_square += error * error;
  }
  EXPECT_GE(shared, 12);
  std::printf("shared traces of a reflector: %.1f dB\n", 10 * std::log10(mean_square / shared));
  EXPECT_LT(10 * std::log10(mean_square / shared), -50);
}

}  // namespace
}  // namespace seaglint

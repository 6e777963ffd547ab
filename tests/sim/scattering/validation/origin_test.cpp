// SPDX-License-Identifier: BSD-3-Clause
// A target whose file has its origin a kilometre away has the echo of the target at its origin, times the phase of the
// translation.
#include <gtest/gtest.h>

#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/solver/solve.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

const double k10 = wavenumber(10e9);
const Vec3 kStep(1000, -300, 40);  // m

// Vertices a kilometre away are rounded by half of 1.1e-13 m per axis, which turns the phases of paths of ten
// reflections by k 2e-12 m = 4e-10 and moves boundaries by as much of a wavelength; phases of 2 k 1000 m are rounded by
// 1e-10. Some tens of contributions as large as the echo cancel.
constexpr double kRounding = 3e-8;

Scatterer moved(const TriangleMesh& mesh, const Vec3& step) {
  return Scatterer(transformed(mesh, Mat3::Identity(), step));
}

double relative_difference(const std::array<Complex, 4>& a, const std::array<Complex, 4>& b) {
  double difference = 0;
  for (int i = 0; i < 4; ++i) difference = std::max(difference, std::abs(a[i] - b[i]));
  return difference / largest(a);
}

std::array<Complex, 4> turned_back(std::array<Complex, 4> s, const Vec3& sum_of_directions) {
  for (Complex& value : s) value *= std::polar(1.0, -k10 * sum_of_directions.dot(kStep));
  return s;
}

TEST(Origin, AtAKilometreChangesThePhaseOnly) {
  const RadarBasis transmit = radar_basis(direction(38, 27)), receive = radar_basis(direction(20, 12));
  for (const BistaticGeometry& geometry : {monostatic(transmit), bistatic(transmit, receive)}) {
    for (const TriangleMesh& mesh : {stepped_corner(), make_sphere(0.2, 3)}) {
      for (const bool edges : {false, true}) {
        const auto at = [&](const Scatterer& target) {
          return scattering_matrices(target, geometry, std::array{k10}, {0, 8, edges})[0];
        };
        const auto far = turned_back(at(moved(mesh, kStep)), geometry.transmit.r + geometry.receive.r);
        EXPECT_LT(relative_difference(at(Scatterer(mesh)), far), kRounding) << geometry.monostatic << edges;
      }
    }
  }
}

// The normal of the plate is the look direction: it is perturbed by 1e-6 rad, which must not turn the phase of the far
// origin by 2 k 1e-3 m.
TEST(Origin, AtAKilometreIsKeptWhereTheLookDirectionIsPerturbed) {
  const RadarBasis basis = radar_basis(Vec3::UnitX());
  const auto near = echo(Scatterer(make_plate(0.4, 0.3)), basis, k10, 0, 8, true);
  const auto far = turned_back(echo(moved(make_plate(0.4, 0.3), kStep), basis, k10, 0, 8, true), 2 * basis.r);
  EXPECT_LT(relative_difference(near, far), kRounding);
}

// The wavefront refers to one point, which in the moved file has other coordinates.
TEST(Origin, IsNotThePointThatARangeRefersTo) {
  const BistaticGeometry geometry = monostatic(radar_basis(direction(38, 27)));
  const auto at = [&](const Scatterer& target, const Vec3& origin) {
    return scattering_matrices(target, geometry, std::array{k10}, {0, 8, true}, 1, {30, origin})[0];
  };
  const auto far = turned_back(at(moved(stepped_corner(), kStep), -kStep), 2 * geometry.transmit.r);
  EXPECT_LT(relative_difference(at(Scatterer(stepped_corner()), Vec3::Zero()), far), kRounding);
}

TEST(Origin, BelongsToThePointsOfAnAspect) {
  const BistaticGeometry geometry = monostatic(radar_basis(direction(38, 27)));
  const Vec3 turn = 1e-4 * geometry.transmit.h;
  const auto at = [&](const Scatterer& target) { return points_of(target, geometry, k10, 1e-3, {0, 8, true}); };
  const ViewResult near = at(Scatterer(stepped_corner())), far = at(moved(stepped_corner(), kStep));
  ASSERT_EQ(near.points.size(), far.points.size());
  EXPECT_LT(relative_difference(near.matrices[0], turned_back(far.matrices[0], 2 * geometry.transmit.r)), kRounding);
  // The turn changes the look direction of either path.
  EXPECT_LT(relative_difference(direct_sum(near.points, k10, turn),
                                turned_back(direct_sum(far.points, k10, turn), 2 * (geometry.transmit.r + turn))),
            kRounding);
}

// A body that rolls about a point far from its file's origin: the same motion in either file.
TEST(Origin, DoesNotMatterInAnInterval) {
  const auto rolling = [](const Vec3& centre) {
    std::vector<MotionSample> samples;
    for (int i = 0; i <= 100; ++i) {
      MotionSample sample;
      for (int axis = 0; axis < 3; ++axis) {
        const double phase = 2 * kPi * 0.01 * i / 4 + 0.7 * axis;
        sample.angles[axis] = 0.1 * std::sin(phase);
        sample.angle_rates[axis] = 0.1 * 2 * kPi / 4 * std::cos(phase);
      }
      samples.push_back(sample);
    }
    return Trajectory(0, 0.01, samples, -centre, centre);
  };
  const IntervalSampling sampling = paper_interval(0.3);
  for (const double range_m : {0.0, 40.0}) {
    SolverSpec solver;
    solver.wavefront_range_m = range_m;
    const auto at = [&](const Vec3& step) {
      return interval_response(moved(stepped_corner(), step), rolling(step), direction(38, 27), Polarisation::kVv,
                               sampling, solver);
    };
    const IntervalResult near = at(Vec3::Zero()), far = at(kStep);
    EXPECT_EQ(near.traces, far.traces);
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < near.response.values.size(); ++i) {
      difference += std::norm(near.response.values[i] - far.response.values[i]);
      size += std::norm(near.response.values[i]);
    }
    // Positions of the centre are rounded by 1e-13 m, at k = 335 / m.
    EXPECT_LT(std::sqrt(difference / size), kRounding) << range_m;
  }
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/solver/solve.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// A radar at a finite range: the second order of the wavefront against sums over its definition.

Complex at_range(const TriangleMesh& mesh, const Vec3& r, double k, double range_m) {
  return scattering_matrices(Scatterer(mesh), monostatic(radar_basis(r)), std::array{k}, TracingSettings{}, 1,
                             {range_m})[0][kVvChannel];
}

// Physical optics of a plate in x = 0, its phase summed over small cells: e^{2jk (r.x - |x_perp|^2 / 2R)}.
Complex summed_plate(double length, double width, const Vec3& r, double k, double range_m) {
  const int cells = 1500;
  Complex sum = 0;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const Vec3 x(0, length * ((i + 0.5) / cells - 0.5), width * ((j + 0.5) / cells - 0.5));
      const double along = r.dot(x);
      sum += std::polar(1.0, 2 * k * (along - (x - along * r).squaredNorm() / (2 * range_m)));
    }
  }
  return Complex(0, -k / (2 * kPi)) * r.x() * sum * (length * width / (cells * cells));
}

TEST(WavefrontCurvature, PlateIsTheSumOverItsCurvedWavefront) {
  const double length = 2, width = 0.8, k = wavenumber(10e9);
  double worst = 0;
  for (const double range_m : {30.0, 100.0, 2000.0}) {
    for (const double azimuth : {0.0, 0.5, 3.0, 20.0}) {
      const Vec3 r = direction(azimuth, 0.7);
      const Complex expected = summed_plate(length, width, r, k, range_m),
                    ours = at_range(make_plate(length, width), r, k, range_m);
      // Frozen amplitudes of decompose() over half of the diagonal / R: kMaxAmplitudeError of the strongest end point;
      // the error of the cells is 1e-5.
      const double size = std::abs(summed_plate(length, width, direction(0, 0.7), k, range_m));
      fmt::print("plate at {} m, {} deg: {:.4f} of the broadside echo\n", range_m, azimuth,
                 std::abs(ours - expected) / size);
      EXPECT_LT(std::abs(ours - expected), 0.02 * size) << range_m << ' ' << azimuth;
      worst = std::max(worst, std::abs(ours - expected) / size);
    }
  }
  record_figure(100 * worst, 2, "wavefront_plate_percent");
}

// For a body on the line of sight only its own size has an effect.
TEST(WavefrontCurvature, CurvedBodyOnTheLineOfSightKeepsItsEcho) {
  const double k = wavenumber(10e9);
  const TriangleMesh sphere = transformed(make_sphere(1, 4), Mat3::Identity(), {20, 0, 0});
  const Vec3 r = direction(0, 0);
  const Complex far = echo(sphere, r, k)[kVvChannel];
  for (const double range_m : {100e3, 20e3, 5e3}) {
    // Amplitudes are frozen over radius / R, 21 / R.
    EXPECT_LT(std::abs(at_range(sphere, r, k, range_m) - far), (1e-3 + 21 / range_m) * std::abs(far)) << range_m;
  }
}

// A shadow edge on the axis has no second order, however fast it slides over the plate on which it falls.
TEST(WavefrontCurvature, SlideOfAShadowEdgeHasNoSecondOrder) {
  const double k = wavenumber(3e9);
  const Mat3 tilt = axis_rotation(radians(50), Vec3::UnitY());
  TriangleMesh mesh = transformed(make_plate(2, 2), tilt, Vec3::Zero());
  TriangleMesh screen = transformed(make_plate(4, 4), Mat3::Identity(), {8, 0, 2});
  screen.part_names = {"screen"};
  mesh.append(screen);
  TracingSettings settings;
  settings.max_bounces = 1;
  settings.filter.included = {{ContributionSelector::Kind::kPart, 0}};
  const Vec3 r = direction(0, 0);
  const auto plate_at = [&](double range_m) {
    return scattering_matrices(Scatterer(mesh), monostatic(radar_basis(r)), std::array{k}, settings, 1,
                               {range_m})[0][kVvChannel];
  };
  const Complex far = plate_at(0), near = plate_at(10e3);
  // Half the plate reaches 1 m off the axis: k 1 / R = 6e-3 rad; amplitudes are frozen over 10 / R.
  EXPECT_LT(std::abs(near - far), 0.02 * std::abs(far));
}

TEST(WavefrontCurvature, AtLongRangeIsTheFarField) {
  const double k = wavenumber(16e9);
  const Vec3 r = direction(20, 10);
  const Complex far = echo(make_icosahedral_reflector(), r, k)[kVvChannel];
  // k radius^2 / R = 8e-6 rad at 1e7 m, and the points' single-precision patterns.
  EXPECT_LT(std::abs(at_range(make_icosahedral_reflector(), r, k, 1e7) - far), 1e-4 * std::abs(far));
}

// Three bounces end where they began: a trihedral's echo is centred at its apex, wherever its faces are, and has the
// path of the apex at any range. Only the wavefront curvature over the aperture reduces it.
TEST(WavefrontCurvature, TrihedralKeepsThePathOfItsApex) {
  const double leg = 0.3, k = wavenumber(16e9), range_m = 500;
  const Vec3 r = Vec3(1, 1, 1).normalized(), offset = 20 * Vec3(1, -1, 0).normalized();
  TriangleMesh mesh = make_triangular_trihedral(leg);
  const Complex at_origin = at_range(mesh, r, k, range_m);
  const Complex moved = at_range(transformed(mesh, Mat3::Identity(), offset), r, k, range_m);
  // The path grows by |x_perp|^2 / R. At 20 m off the axis the radar is d = 2.3 deg off the boresight, which reduces a
  // triangular aperture by d^2 and changes its first bounces' interference by some 2 / (k leg); its centre is up to leg
  // / 2 from the apex, where the wavefront's second order is k (leg / 2)^2 / R.
  const Complex ratio = moved / at_origin * std::polar(1.0, k * offset.squaredNorm() / range_m);
  const double off_axis = offset.norm() / range_m;
  EXPECT_NEAR(std::abs(ratio), 1, off_axis * off_axis + 2 / (k * leg));
  EXPECT_NEAR(std::arg(ratio), 0, 2 / (k * leg) + k * leg * leg / 4 / range_m);
}

// Three bounces return the wave that meets the aperture at p from -p, so that its path is longer by |p|^2 / R. Seen
// along the axis the aperture of legs a is a regular hexagon about the apex, of sides a sqrt(2) / 3.
TEST(WavefrontCurvature, OfATrihedralIsThatOfItsAperture) {
  const double leg = 1, k = wavenumber(16e9), side = leg * std::numbers::sqrt2 / 3;
  const Scatterer corner(make_triangular_trihedral(leg));
  TracingSettings settings;
  settings.filter.included = {{ContributionSelector::Kind::kBounces, 3}};
  const RadarBasis axis = radar_basis(Vec3(1, 1, 1).normalized());
  for (const double range_m : {20.0, 40.0, 100.0}) {
    const auto s = scattering_matrices(corner, monostatic(axis), std::array{k}, settings, 1, {range_m})[0];
    // Twelve right triangles of height sqrt(3) side / 2 and angle 30 deg, in rings of equal distance from the apex.
    const int rings = 20000;
    const double height = std::numbers::sqrt3 / 2 * side;
    Complex sum = 0;
    for (int i = 0; i < rings; ++i) {
      const double r = (i + 0.5) / rings * side;
      const double arc = r <= height ? kPi / 6 : kPi / 6 - std::acos(height / r);
      sum += 12 * r * arc * std::polar(1.0, -k * r * r / range_m) * (side / rings);
    }
    const double expected = k / (2 * kPi) * std::abs(sum);
    fmt::print("trihedral at {} m: {:.4f} of {:.4f} m, {:.4f} m far away\n", range_m, std::abs(s[kHhChannel]), expected,
               k / (2 * kPi) * leg * leg / std::numbers::sqrt3);
    EXPECT_NEAR(std::abs(s[kHhChannel]) / expected, 1, 0.005) << range_m;
    // In an interval, at rest, with the few other bounces. A piece is a point at its centroid, which leaves out the
    // mean of its own second order, and the two decompositions cut differently: 0.011 rad at most from 20 m to 1000 m,
    // and a quarter of it where pieces end at half of kMaxHalfPhase.
    SolverSpec solver;
    solver.edges = false;
    solver.wavefront_range_m = range_m;
    const Complex at_rest = interval_response(corner, Trajectory::at_rest(Vec3::Zero()), axis.r, Polarisation::kHh,
                                              {16e9, 1e6, 1, 1, {0}, {0.0}}, solver)
                                .response.at(0, 0);
    const TracingSettings all{0, solver.max_bounces, false};
    const Complex matrix =
        scattering_matrices(corner, monostatic(axis), std::array{k}, all, 1, {range_m})[0][kHhChannel];
    EXPECT_LT(std::abs(at_rest - matrix), 0.02 * expected) << range_m;
  }
}

// A float of a layout has its own origin, whereas the radar's range refers to that of the layout.
TEST(WavefrontCurvature, PlateOffTheReferencePointIsTheSumOfItsPointDistances) {
  const double length = 2, width = 0.8, range_m = 1000;
  const Vec3 rest(5, 60, 0.75);
  const Scatterer plate(make_plate(length, width));
  const IntervalSampling sampling{10e9, 1e6, 1, 1, {0}, {0.0}};
  SolverSpec solver;
  solver.edges = false;
  solver.wavefront_range_m = range_m;
  const double k = wavenumber(10e9);
  const auto summed = [&](const Vec3& r) {
    const int cells = 600;
    Complex sum = 0;
    for (int i = 0; i < cells; ++i) {
      for (int j = 0; j < cells; ++j) {
        const Vec3 x = rest + Vec3(0, length * ((i + 0.5) / cells - 0.5), width * ((j + 0.5) / cells - 0.5));
        sum += std::polar(1.0, -2 * k * ((range_m * r - x).norm() - range_m));
      }
    }
    const double facing = (range_m * r - rest).normalized().x();
    return Complex(0, -k / (2 * kPi)) * facing * sum * (length * width / (cells * cells));
  };
  for (const double azimuth : {0.0, 3.0, 3.44, 3.8, 6.0}) {  // its normal points to the radar near 3.44 deg
    const Vec3 r = direction(azimuth, 0.7);
    const Complex ours =
        interval_response(plate, Trajectory::at_rest(rest), r, Polarisation::kVv, sampling, solver).response.at(0, 0);
    const double size = k * length * width / (2 * kPi), error = std::abs(ours - summed(r)) / size;
    fmt::print("plate 60 m off the reference point at {} m, {} deg: {:.4f} of the broadside echo\n", range_m, azimuth,
               error);
    EXPECT_LT(error, 0.02) << azimuth;  // frozen amplitudes of decompose() as above
  }
}

TEST(WavefrontCurvature, RefusesARadarInsideOrNearTheTarget) {
  EXPECT_THROW(at_range(make_plate(2, 1), Vec3::UnitX(), 200, 0.5), InputError);
  EXPECT_THROW(at_range(make_plate(2, 1), Vec3::UnitX(), 200, 10), InputError);
}

// A target whose file has its origin a kilometre away has the echo of the target at its origin, times the phase of the
// translation.

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

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/measured.h"
#include "tests/sim/geometry/mesh_changes.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;
using namespace testing_meshes;

// Invariances of the solver for any target: translation, rotation, mirror symmetry, scaling, reciprocity, tessellation,
// threads.

const double k10 = wavenumber(10e9);

double difference(const std::array<Complex, 4>& a, const std::array<Complex, 4>& b) {
  double size = 0;
  for (int i = 0; i < 4; ++i) size = std::max(size, std::abs(a[i] - b[i]));
  return size;
}

// A patch just below the smallest size on one target may be just above it on the moved one. With patches of a 400th of
// the target, such slivers are below 1e-3 of the projection's width and their echo below 1e-4 of the whole.
constexpr double kSlivers = 2e-4;
constexpr double kFine = 1.4e-4;  // m

TEST(Invariance, MovingATargetTowardsTheRadarAdvancesThePhase) {
  const Vec3 r = direction(38, 27), step(0.31, -0.22, 0.47);
  const auto at_origin = echo(stepped_corner(), r, k10, kFine);
  auto moved = echo(transformed(stepped_corner(), Mat3::Identity(), step), r, k10, kFine);
  for (Complex& s : moved) s *= std::polar(1.0, -2 * k10 * r.dot(step));
  EXPECT_LT(difference(at_origin, moved), kSlivers * largest(at_origin));
}

TEST(Invariance, CommonRotationChangesNothing) {
  const Mat3 rotation = axis_rotation(1.1, Vec3(0.3, -1, 0.6).normalized());
  const RadarBasis basis = radar_basis(direction(41, 22));
  const RadarBasis rotated{rotation * basis.r, rotation * basis.h, rotation * basis.v};
  const auto before = echo(Scatterer(stepped_corner()), basis, k10, kFine);
  const auto after = echo(Scatterer(transformed(stepped_corner(), rotation, Vec3::Zero())), rotated, k10, kFine);
  EXPECT_LT(difference(before, after), kSlivers * largest(before));
}

TEST(Invariance, MirroredTargetHasOppositeCrossPolarisation) {
  TriangleMesh mirrored = stepped_corner();
  for (Vec3& x : mirrored.vertices) x.y() = -x.y();
  const auto before = echo(stepped_corner(), direction(35, 25), k10, kFine);
  auto after = echo(mirrored, direction(-35, 25), k10, kFine);
  after[kHvChannel] = -after[kHvChannel];
  after[kVhChannel] = -after[kVhChannel];
  EXPECT_LT(difference(before, after), kSlivers * largest(before));
}

TEST(Invariance, TwiceTheSizeAtHalfTheFrequencyDoublesTheAmplitude) {
  TriangleMesh large = stepped_corner();
  for (Vec3& x : large.vertices) x *= 2;
  const auto small_echo = echo(stepped_corner(), direction(40, 30), k10, kFine);
  auto large_echo = echo(large, direction(40, 30), k10 / 2, 2 * kFine);
  for (Complex& s : large_echo) s *= 0.5;
  EXPECT_LT(difference(small_echo, large_echo), kSlivers * largest(small_echo));
}

TEST(Invariance, TheFirstBounceIsReciprocalToRounding) {
  for (const double azimuth : {12.0, 33.0, 71.0}) {
    const auto s = echo(stepped_corner(), direction(azimuth, 24), k10, kFine, 1);
    EXPECT_LT(std::abs(s[kHvChannel] - s[kVhChannel]), 1e-9 * largest(s)) << azimuth;
  }
}

TEST(Invariance, ManyBouncesAreReciprocalWithinPhysicalOptics) {
  // Physical optics radiates the currents of every bounce, but only geometrical optics illuminates the next one: a path
  // and its reciprocal differ by diffraction, about 1/(k a) = 1/84 of the amplitude.
  const Scatterer corner(make_triangular_trihedral(0.4));
  double max_error = 0;
  for (const double azimuth : {25.0, 45.0, 60.0}) {
    const std::array pair{monostatic(radar_basis(direction(azimuth, 35.264)))};
    const auto s = one_way_matrices(corner, pair, std::array{k10}, {kFine, 8})[0][0];
    max_error = std::max(max_error, std::abs(s[kHvChannel] - s[kVhChannel]) / largest(s));
  }
  RecordProperty("worst_relative", std::to_string(max_error));
  EXPECT_LT(max_error, 0.03);
}

TEST(Invariance, FlatFaceIndependentOfTriangulation) {
  const TriangleMesh whole = make_plate(0.5, 0.4), cut = cut_plate(0.5, 0.4, 17);
  for (const double azimuth : {0.0, 17.0, 58.0}) {
    const auto one = echo(whole, direction(azimuth, 9), k10, 1.4e-3),
               many = echo(cut, direction(azimuth, 9), k10, 1.4e-3);
    EXPECT_LT(difference(one, many), 1e-9 * 0.2 * k10) << azimuth;
  }
}

TEST(Invariance, NoBitDependsOnTheNumberOfThreads) {
  const Scatterer corner(stepped_corner());
  const RadarBasis basis = radar_basis(direction(40, 30));
  const std::array ks{k10, 1.01 * k10};
  const auto one = scattering_matrices(corner, monostatic(basis), ks, {kFine, 8}, 1),
             two = scattering_matrices(corner, monostatic(basis), ks, {kFine, 8}, 2);
  EXPECT_EQ(one, two);
}

TEST(Invariance, ShadowHasTheShapeOfTheHidingPlate) {
  // A small plate 1 m in front of a large one, both facing the radar: the shadow has the area of the small plate
  // exactly.
  TriangleMesh mesh = make_plate(0.6, 0.6);
  mesh.append(transformed(make_plate(0.2, 0.3), Mat3::Identity(), {1.0, 0.05, -0.02}));
  const auto s = echo(mesh, Vec3::UnitX(), k10, 2e-3);
  const Complex expected = Complex(0, -k10 / (2 * kPi)) * (0.36 - 0.06 + 0.06 * std::polar(1.0, 2 * k10 * 1.0));
  EXPECT_LT(std::abs(s[kVvChannel] - expected), 1e-9 * std::abs(expected));
}

TEST(Invariance, FacetsThatCoincideCountOnce) {
  TriangleMesh twice = make_plate(0.3, 0.2);
  twice.append(make_plate(0.3, 0.2));
  const auto once = echo(make_plate(0.3, 0.2), direction(15, 10), k10), doubled = echo(twice, direction(15, 10), k10);
  EXPECT_LT(difference(once, doubled), 1e-9 * largest(once));
}

TEST(Invariance, IntersectingFacetsHideEachOtherBehindTheirCommonLine) {
  // Two crossed plates viewed along the bisector: of each the half in front is visible.
  const auto plate = [](double angle) {
    return transformed(make_plate(0.4, 0.3), axis_rotation(angle, Vec3::UnitZ()), Vec3::Zero());
  };
  TriangleMesh crossed = plate(radians(30));
  crossed.append(plate(radians(-30)));
  // The same surface with the hidden halves removed: the visible halves meet in a valley line x = 0 and are those with
  // x > 0.
  const auto half = [](double angle, double side) {
    TriangleMesh mesh = make_plate(0.2, 0.3);
    for (Vec3& x : mesh.vertices) x.y() += side * 0.1;
    return transformed(mesh, axis_rotation(angle, Vec3::UnitZ()), Vec3::Zero());
  };
  TriangleMesh visible = half(radians(30), -1);
  visible.append(half(radians(-30), +1));
  const auto all = echo(crossed, Vec3::UnitX(), k10, 3.5e-4, 1), front = echo(visible, Vec3::UnitX(), k10, 3.5e-4, 1);
  EXPECT_LT(difference(all, front), 1e-6 * 0.12 * k10);
}

// One surface, other meshes: the echo does not depend on how a body was cut, numbered, split, turned or moved.

// hh and vv in eight views at three frequencies; the body is turned by `turn` and moved by `shift`, and so is the
// radar.
std::vector<Complex> echoes(const TriangleMesh& mesh, const Mat3& turn = Mat3::Identity(),
                            const Vec3& shift = Vec3::Zero()) {
  const Scatterer scatterer(mesh);
  const std::array<double, 3> k{wavenumber(9.9e9), wavenumber(10e9), wavenumber(10.1e9)};
  std::vector<Complex> all;
  for (int i = 0; i < 8; ++i) {
    RadarBasis basis = radar_basis(direction(17 + 45.0 * i, 12 + i));
    for (Vec3* x : {&basis.r, &basis.h, &basis.v}) *x = turn * *x;
    const auto matrices = scattering_matrices(scatterer, monostatic(basis), k, {0, 6, true});
    for (std::size_t q = 0; q < k.size(); ++q)
      for (const Channel channel : {kHhChannel, kVvChannel})
        all.push_back(matrices[q][channel] * std::polar(1.0, -2 * k[q] * basis.r.dot(shift)));
  }
  return all;
}

double relative_change(const std::vector<Complex>& from, const std::vector<Complex>& to) {
  RelativeError error;
  for (std::size_t i = 0; i < from.size(); ++i) error.add(to[i], from[i]);
  return error.value();
}

// Terms: the choice between contour and point terms at a facet, kContourRatio^-1.5 of its contribution; a few facets
// next to the smallest patch.
TEST(MeshInvariance, OfRandomBodies) {
  double cut = 0, rounded = 0, order = 0, turned = 0, moved = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const TriangleMesh body = random_body(seed);
    const std::vector<Complex> expected = echoes(body);
    Random random({seed, Stream::kTest, 1});
    const Mat3 turn = axis_rotation(1.1, Vec3(1, -2, 0.5).normalized());
    const Vec3 shift(12, -9, 3);
    cut = std::max(cut, relative_change(expected, echoes(cut_in_four(cut_in_four(body)))));
    rounded = std::max(rounded, relative_change(expected, echoes(cut_in_four(body, true))));
    order = std::max(order, relative_change(expected, echoes(split_vertices(renumbered(body, random)))));
    turned = std::max(turned, relative_change(expected, echoes(transformed(body, turn, Vec3::Zero()), turn)));
    moved = std::max(
        moved, relative_change(expected, echoes(transformed(body, Mat3::Identity(), shift), Mat3::Identity(), shift)));
  }
  std::printf("relative change: cut %.4f, cut and rounded %.4f, renumbered and split %.4f, turned %.4f, moved %.4f\n",
              cut, rounded, order, turned, moved);
  record_figure(cut, 4, "mesh_cut_change");
  record_figure(rounded, 4, "mesh_cut_rounded_change");
  record_figure(order, 4, "mesh_renumbered_change");
  record_figure(turned, 4, "mesh_turned_change");
  record_figure(moved, 4, "mesh_moved_change");
  for (const double change : {cut, order, moved}) EXPECT_LT(change, 0.02);
  EXPECT_LT(rounded, 0.1);
  // A turned cylinder has other diagonals in its sides, and the parts of its beams whose rays are limited next to the
  // border of the plate have other shapes (rays_are_limited() of the beam tracer).
  EXPECT_LT(turned, 0.05);
}

}  // namespace
}  // namespace seaglint

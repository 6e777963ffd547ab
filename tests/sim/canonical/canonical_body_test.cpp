// SPDX-License-Identifier: BSD-3-Clause
// Bodies that are recognised from their mesh, and those that are none of them.
#include "sim/canonical/canonical_body.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

// Moved and turned so that no axis or origin is special.
TriangleMesh displaced(const TriangleMesh& mesh) {
  const Mat3 rotation = axis_rotation(0.4, Vec3(1, 2, -0.5).normalized());
  return transformed(mesh, rotation, Vec3(3, -2, 0.7));
}

// Coordinates in single precision, as of files, each triangle with vertices of its own.
TriangleMesh as_of_a_file(const TriangleMesh& mesh) {
  TriangleMesh soup = mesh;
  soup.vertices.clear();
  for (auto& triangle : soup.triangles) {
    for (std::uint32_t& vertex : triangle) {
      soup.vertices.push_back(mesh.vertices[vertex].cast<float>().cast<double>());
      vertex = static_cast<std::uint32_t>(soup.vertices.size() - 1);
    }
  }
  return soup;
}

TEST(CanonicalBodies, SphereHasItsCentreAndRadius) {
  const auto body = canonical_body(as_of_a_file(displaced(make_sphere(0.3, 3))));
  ASSERT_TRUE(body);
  EXPECT_EQ(body->shape, CanonicalShape::kSphere);
  EXPECT_NEAR(body->a_m, 0.3, 1e-6);
  EXPECT_LT((body->centre_m - Vec3(3, -2, 0.7)).norm(), 1e-6);
  EXPECT_EQ(text_of(*body), "sphere of radius 0.3 m");
}

TEST(CanonicalBodies, PlateHasItsSidesAndNormal) {
  for (const auto& [length, width] : {std::pair{0.5, 0.3}, {0.4, 0.4}, {10.0, 0.2}}) {
    const auto body = canonical_body(as_of_a_file(displaced(make_plate(length, width))));
    ASSERT_TRUE(body) << length;
    EXPECT_EQ(body->shape, CanonicalShape::kPlate);
    EXPECT_NEAR(body->a_m, length, 1e-5);
    EXPECT_NEAR(body->b_m, width, 1e-5);
    EXPECT_NEAR(body->axes.determinant(), 1, 1e-5);
  }
}

TEST(CanonicalBodies, DihedralHasItsFacesAndSeam) {
  const auto body = canonical_body(as_of_a_file(make_dihedral(0.25, 0.3, kPi / 2)));
  ASSERT_TRUE(body);
  EXPECT_EQ(body->shape, CanonicalShape::kDihedral);
  EXPECT_NEAR(body->a_m * body->b_m, 0.25 * 0.3, 1e-6);
  EXPECT_NEAR(std::abs(body->axes.col(2).z()), 1, 1e-6);
  EXPECT_NEAR((body->axes.col(0) + body->axes.col(1)).normalized().x(), 1, 1e-6);
}

TEST(CanonicalBodies, TrihedralHasItsLegsAndApex) {
  const auto body = canonical_body(as_of_a_file(displaced(make_triangular_trihedral(0.5))));
  ASSERT_TRUE(body);
  EXPECT_EQ(body->shape, CanonicalShape::kTriangularTrihedral);
  EXPECT_NEAR(body->a_m, 0.5, 1e-5);
  EXPECT_LT((body->centre_m - Vec3(3, -2, 0.7)).norm(), 1e-5);
}

TEST(CanonicalBodies, SquareTrihedralIsNotATriangularOne) {
  const auto body = canonical_body(displaced(make_square_trihedral(0.4)));
  ASSERT_TRUE(body);
  EXPECT_EQ(body->shape, CanonicalShape::kSquareTrihedral);
  EXPECT_NEAR(body->a_m, 0.4, 1e-9);
}

TEST(CanonicalBodies, OthersAreNone) {
  EXPECT_FALSE(canonical_body({}));
  EXPECT_FALSE(canonical_body(make_dihedral(0.25, 0.3, radians(89)))) << "not at right angles";
  TriangleMesh ellipsoid = make_sphere(1, 3);
  for (Vec3& p : ellipsoid.vertices) p.z() *= 1.01;
  EXPECT_FALSE(canonical_body(ellipsoid));
  EXPECT_FALSE(canonical_body(make_sphere(1, 0))) << "an icosahedron";
  TriangleMesh dented = make_sphere(1, 3);
  dented.triangles.resize(dented.triangles.size() * 9 / 10);
  EXPECT_FALSE(canonical_body(dented)) << "a sphere with a hole";
  TriangleMesh half = make_plate(0.5, 0.3);
  half.triangles.resize(half.triangles.size() / 2);
  EXPECT_FALSE(canonical_body(half)) << "half a plate";
  EXPECT_FALSE(canonical_body(make_icosahedral_reflector()));
  EXPECT_FALSE(canonical_body(make_cylinder(0.5, 1, 64)));
  TriangleMesh cut = make_triangular_trihedral(0.5);
  cut.triangles.pop_back();
  EXPECT_NE(canonical_body(cut).value_or(CanonicalBody{}).shape, CanonicalShape::kTriangularTrihedral);
}

TEST(CanonicalBodies, SpheresOfOneMeshAreAllFound) {
  TriangleMesh spheres = transformed(make_sphere(0.2, 3), Mat3::Identity(), Vec3(-8, 0, 0));
  spheres.append(make_sphere(0.3, 3));
  const std::vector<CanonicalBody> bodies = canonical_bodies(spheres);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_NEAR(bodies[0].a_m, 0.2, 1e-6);
  EXPECT_NEAR(bodies[1].a_m, 0.3, 1e-6);
  spheres.append(make_plate(1, 1));
  EXPECT_TRUE(canonical_bodies(spheres).empty()) << "a plate among them";
}

// Exact and closed-form echoes: independent series, published peaks, reciprocity, and the solver by physical optics.

using namespace testing_echoes;

constexpr double kDigits = 1e-9;                          // of the references
const double kUnitFrequency = kSpeedOfLight / (2 * kPi);  // k = 1 rad/m: a radius is ka

CanonicalBody sphere(double radius, const Vec3& centre = Vec3::Zero()) {
  return {CanonicalShape::kSphere, centre, radius, 0, Mat3::Identity()};
}

std::array<Complex, 4> matrix(const CanonicalBody& body, double frequency_hz, const BistaticGeometry& geometry) {
  const auto echo = CanonicalSolution(body, frequency_hz).at(geometry);
  EXPECT_TRUE(echo);
  return echo.value_or(CanonicalEcho{}).matrix_m;
}

TEST(MieSphere, BackscatterIsThatOfTheIndependentSeries) {
  for (const char* file : {"mie_sphere.csv", "mie_sphere_ka60_200.csv"}) {
    for (const auto& row : read_csv(file)) {
      const double ka = std::stod(row[0]);
      const auto s = matrix(sphere(ka), kUnitFrequency, monostatic(radar_basis(direction(31, 17))));
      const Complex expected = ka * Complex(std::stod(row[1]), std::stod(row[2]));
      EXPECT_LT(std::abs(s[kHhChannel] - expected), kDigits * ka) << ka;
      EXPECT_LT(std::abs(s[kVvChannel] - expected), kDigits * ka) << ka;
      EXPECT_LT(std::abs(s[kHvChannel]), 1e-12 * ka) << ka;
    }
  }
}

// The wave travels along +z with E along x; receivers in the planes phi = 0 (E_theta) and phi = 90 deg (E_phi).
TEST(MieSphere, BistaticCutsAreThoseOfTheIndependentSeries) {
  const RadarBasis transmit{-Vec3::UnitZ(), Vec3::UnitX(), (-Vec3::UnitZ()).cross(Vec3::UnitX())};
  int count = 0;
  for (const auto& row : read_csv("mie_sphere_bistatic.csv")) {
    const double ka = std::stod(row[0]), theta = radians(std::stod(row[1]));
    const auto towards = [&](const Vec3& across, const Vec3& received) {
      const Vec3 r = std::cos(theta) * Vec3::UnitZ() + std::sin(theta) * across;
      return bistatic(transmit, {r, received, r.cross(received)});
    };
    const Vec3 theta_hat = std::cos(theta) * Vec3::UnitX() - std::sin(theta) * Vec3::UnitZ();
    const Complex parallel = matrix(sphere(ka), kUnitFrequency, towards(Vec3::UnitX(), theta_hat))[kHhChannel];
    const Complex normal = matrix(sphere(ka), kUnitFrequency, towards(Vec3::UnitY(), -Vec3::UnitX()))[kHhChannel];
    // The forward lobe (ka)^2 / 2 of the largest sphere loses digits of its sum, 1e-11 of it.
    EXPECT_LT(std::abs(parallel - ka * Complex(std::stod(row[2]), std::stod(row[3]))), kDigits * ka * (1 + ka / 2));
    EXPECT_LT(std::abs(normal - ka * Complex(std::stod(row[4]), std::stod(row[5]))), kDigits * ka * (1 + ka / 2));
    ++count;
  }
  EXPECT_EQ(count, 190);
}

TEST(MieSphere, IsReciprocalAndMovesItsPhaseWithItsCentre) {
  const RadarBasis a = radar_basis(direction(20, 35)), b = radar_basis(direction(-70, -10));
  const double ka = 40, k = 1;
  const auto there = matrix(sphere(ka), kUnitFrequency, bistatic(a, b));
  const auto back = matrix(sphere(ka), kUnitFrequency, bistatic(b, a));
  for (const auto& [p, q] : {std::pair{0, 0}, {1, 2}, {2, 1}, {3, 3}})
    EXPECT_LT(std::abs(there[p] - back[q]), 1e-10 * ka) << p;
  const Vec3 centre(5, -2, 3);
  const auto moved = matrix(sphere(ka, centre), kUnitFrequency, bistatic(a, b));
  EXPECT_LT(std::abs(moved[0] - there[0] * std::polar(1.0, k * centre.dot(a.r + b.r))), 1e-10 * ka);
}

// Low-frequency limit of a conducting sphere: sigma = 9 pi a^2 (ka)^4 (Ruck, Radar Cross Section Handbook, eq. 3.2-18).
TEST(MieSphere, HasTheRayleighLimit) {
  const double ka = 1e-3;
  const auto s = matrix(sphere(ka), kUnitFrequency, monostatic(radar_basis(Vec3::UnitX())));
  EXPECT_NEAR(4 * kPi * std::norm(s[kHhChannel]) / (9 * kPi * std::pow(ka, 6)), 1, 1e-5);
}

// Peaks of Knott, Shaeffer and Tuley, table 6.1, in dBsm.
TEST(ClosedForms, HaveTheirPublishedPeaks) {
  const double f = 16e9, lambda = kSpeedOfLight / f, a = 0.3, b = 0.2;
  const auto peak = [&](const TriangleMesh& mesh, const Vec3& r, int channel) {
    return dbsm(matrix(canonical_body(mesh).value(), f, monostatic(radar_basis(r)))[static_cast<std::size_t>(channel)]);
  };
  const Vec3 diagonal = Vec3(1, 1, 1).normalized();
  const auto level = [&](double sigma) { return 10 * std::log10(sigma / (lambda * lambda)); };
  for (const int channel : {kHhChannel, kVvChannel}) {
    EXPECT_NEAR(peak(make_plate(a, b), Vec3::UnitX(), channel), level(4 * kPi * a * a * b * b), 1e-9);
    EXPECT_NEAR(peak(make_dihedral(b, a, kPi / 2), Vec3::UnitX(), channel), level(8 * kPi * a * a * b * b), 1e-9);
    EXPECT_NEAR(peak(make_triangular_trihedral(a), diagonal, channel), level(4 * kPi * std::pow(a, 4) / 3), 1e-9);
    EXPECT_NEAR(peak(make_square_trihedral(a), diagonal, channel), level(12 * kPi * std::pow(a, 4)), 1e-9);
  }
}

// Amplitude and phase of the solver's physical optics agree to the relative error that the closed form states, for
// bodies turned and moved; a dihedral whose seam is inclined has a cross-polar echo.
TEST(ClosedForms, AreThoseOfTheSolverWithinTheirStatedError) {
  const Mat3 turn = axis_rotation(0.6, Vec3(1, -2, 0.7).normalized());
  const Vec3 origin(0.2, -0.1, 0.3), trihedral_axis = direction(45, 35.2643896827547);
  const double f = 16e9;
  const std::vector<std::pair<TriangleMesh, Vec3>> cases{{make_plate(0.3, 0.2), Vec3::UnitX()},
                                                         {make_plate(0.3, 0.2), direction(0.4, 0.5)},
                                                         {make_dihedral(0.25, 0.3, kPi / 2), direction(0.2, 0.1)},
                                                         {make_triangular_trihedral(0.4), trihedral_axis},
                                                         {make_triangular_trihedral(0.4), direction(49, 34)},
                                                         {make_square_trihedral(0.3), trihedral_axis}};
  for (std::size_t n = 0; n < cases.size(); ++n) {
    SCOPED_TRACE(n);
    const TriangleMesh mesh = transformed(cases[n].first, turn, origin);
    const RadarBasis basis = radar_basis(turn * cases[n].second);
    const auto known = CanonicalSolution(canonical_body(mesh).value(), f).at(monostatic(basis));
    ASSERT_TRUE(known);
    EXPECT_GT(known->relative_error, 0);
    const auto solved = echo(mesh, basis.r, wavenumber(f));
    for (std::size_t e = 0; e < 4; ++e)
      EXPECT_LT(std::abs(known->matrix_m[e] - solved[e]), known->relative_error * largest(solved)) << e;
  }
}

TEST(ClosedForms, EndWhereTheyDoNotApply) {
  const auto at = [](const TriangleMesh& mesh, double frequency_hz, const BistaticGeometry& geometry) {
    return CanonicalSolution(canonical_body(mesh).value(), frequency_hz).at(geometry).has_value();
  };
  const auto along = [](const Vec3& r) { return monostatic(radar_basis(r)); };
  const TriangleMesh plate = make_plate(0.3, 0.2);
  EXPECT_TRUE(at(plate, 10e9, along(Vec3::UnitX())));
  EXPECT_FALSE(at(plate, 10e9, along(direction(10, 0)))) << "beyond the main lobe";
  EXPECT_FALSE(at(plate, 10e9, along(Vec3::UnitY()))) << "edge-on";
  EXPECT_FALSE(at(plate, 2e9, along(Vec3::UnitX()))) << "k b = 8.4";
  EXPECT_FALSE(at(plate, 10e9, bistatic(radar_basis(Vec3::UnitX()), radar_basis(direction(2, 0)))));
  EXPECT_FALSE(at(make_dihedral(0.2, 0.3, kPi / 2), 10e9, along(direction(1, 0))));
  EXPECT_FALSE(at(make_dihedral(0.2, 0.3, kPi / 2), 10e9, along(direction(0, 5))));
  EXPECT_FALSE(at(make_dihedral(0.2, 0.3, kPi / 2), 10e9, along(direction(180, 0)))) << "from behind";
  EXPECT_FALSE(at(make_triangular_trihedral(0.3), 10e9, along(direction(52, 35)))) << "5.7 deg off its axis";
  EXPECT_FALSE(at(make_square_trihedral(0.3), 10e9, along(direction(47, 35))));
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Exact and closed-form echoes: independent series, published peaks, reciprocity, and the solver by physical optics.
#include "sim/canonical/canonical_echo.h"
#include "sim/core/numbers/rotation.h"

#include <gtest/gtest.h>

#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

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

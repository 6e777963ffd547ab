// SPDX-License-Identifier: BSD-3-Clause
// Separate transmit and receive directions.
#include <gtest/gtest.h>

#include "sim/core/numbers/real_functions.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

constexpr double kF = 10e9;

TriangleMesh plate(double a, double b) {
  TriangleMesh mesh;
  mesh.vertices = {{-a / 2, -b / 2, 0}, {a / 2, -b / 2, 0}, {a / 2, b / 2, 0}, {-a / 2, b / 2, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

std::array<Complex, 4> bistatic_echo(const Scatterer& scatterer, const Vec3& r_t, const Vec3& r_s, int bounces = 8) {
  return scattering_matrices(scatterer, bistatic(radar_basis(r_t), radar_basis(r_s)), std::array{wavenumber(kF)},
                             {0.01, bounces})[0];
}

// In the specular direction the whole plate radiates in phase: |S| = A cos(theta) / lambda. Geometrical optics reflects
// v as v and h as -h, which is the h of the other side.
TEST(Bistatic, PlateReflectsIntoTheSpecularDirection) {
  const Scatterer target(plate(0.3, 0.2));
  const double lambda = kSpeedOfLight / kF;
  for (const double theta : {5.0, 30.0, 60.0, 80.0}) {
    const auto s = bistatic_echo(target, direction(0, 90 - theta), direction(180, 90 - theta));
    const Complex expected(0, 0.06 * std::cos(radians(theta)) / lambda);
    EXPECT_NEAR(std::abs(s[kHhChannel] - expected), 0, 1e-9 * std::abs(expected)) << theta;
    EXPECT_NEAR(std::abs(s[kVvChannel] - expected), 0, 1e-9 * std::abs(expected)) << theta;
    EXPECT_NEAR(std::abs(s[kHvChannel]), 0, 1e-9 * std::abs(expected)) << theta;
  }
}

// Balanis, Advanced Engineering Electromagnetics, section 11.3.2: a sinc for each side.
TEST(Bistatic, PlatePatternIsTheSincOfTheBisector) {
  const double a = 0.3, b = 0.2, k = wavenumber(kF);
  const Scatterer target(plate(a, b));
  for (const double azimuth : {20.0, 100.0, 215.0}) {
    const Vec3 r_t = direction(0, 60), r_s = direction(azimuth, 40);
    const Vec3 both = r_t + r_s;
    const auto sinc_of = [](double x) { return std::abs(x) < 1e-9 ? 1.0 : std::sin(x) / x; };
    const double shape = sinc_of(k * both.x() * a / 2) * sinc_of(k * both.y() * b / 2);
    const auto s = bistatic_echo(target, r_t, r_s);
    // v transmitted: H = k^ x E along the plate; J = 2 z^ x H.
    const RadarBasis t = radar_basis(r_t), e = radar_basis(r_s);
    const Vec3 J = Vec3::UnitZ().cross((-r_t).cross(t.v));
    const Complex factor = Complex(0, -k / (2 * kPi)) * a * b * shape;
    EXPECT_NEAR(std::abs(s[kVvChannel] - factor * e.v.dot(J)), 0, 1e-9 * a * b * k);
    EXPECT_NEAR(std::abs(s[kHvChannel] - factor * e.h.dot(J)), 0, 1e-9 * a * b * k);
  }
}

TEST(Bistatic, EqualDirectionsAreTheMonostaticEcho) {
  const Scatterer corner(make_icosahedral_reflector());
  const RadarBasis basis = radar_basis(direction(33, 7));
  const std::array k{wavenumber(kF)};
  const auto one = scattering_matrices(corner, monostatic(basis), k, {})[0];
  const auto two = scattering_matrices(corner, bistatic(basis, basis), k, {})[0];
  // Slivers below the smallest patch area differ.
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(std::abs(one[i] - two[i]), 0, 1e-5);
}

TEST(Bistatic, TranslationChangesThePhaseByBothPaths) {
  TriangleMesh mesh = make_icosahedral_reflector();
  const Vec3 r_t = direction(33, 7), r_s = direction(52, -4), shift(0.7, -1.1, 0.4);
  const auto before = bistatic_echo(Scatterer(mesh), r_t, r_s);
  for (Vec3& vertex : mesh.vertices) vertex += shift;
  const auto after = bistatic_echo(Scatterer(mesh), r_t, r_s);
  const Complex phase = std::polar(1.0, wavenumber(kF) * shift.dot(r_t + r_s));
  const double size = std::abs(before[kVvChannel]) + std::abs(before[kHhChannel]);
  // As for the monostatic case (invariance_test): slivers of about the smallest patch size.
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(std::abs(after[i] - before[i] * phase), 0, 1e-3 * size);
}

// A right-angled dihedral reflects a wave from any direction of its cross-section back towards its source, and
// specularly along its seam.
TEST(Bistatic, DihedralIsSpecularAlongItsSeam) {
  const double side = 0.3, k = wavenumber(kF);
  TriangleMesh mesh;  // faces in x = 0 and y = 0, seam along z
  mesh.vertices = {{0, 0, -side / 2}, {side, 0, -side / 2}, {side, 0, side / 2},
                   {0, 0, side / 2},  {0, side, -side / 2}, {0, side, side / 2}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 4, 5}, {0, 5, 3}};
  const Scatterer dihedral(mesh);
  const double el = 20;
  const auto s = scattering_matrices(
      dihedral, bistatic(radar_basis(direction(45, el)), radar_basis(direction(45, -el))), std::array{k}, {7e-4, 2})[0];
  // Two bounces: aperture 2 side sin 45 x side cos(el) in phase, less the part that passes the end while it propagates
  // from face to face (sqrt2 x tan(el) along the seam at x from it), in addition to single bounces without a specular
  // direction.
  const double kept = 1 - std::tan(radians(el)) / std::sqrt(2.0);
  const double aperture = kept * std::sqrt(2.0) * side * side * std::cos(radians(el)) * k / (2 * kPi);
  EXPECT_NEAR(std::abs(s[kVvChannel]), aperture, 0.03 * aperture);
  EXPECT_NEAR(std::abs(s[kHhChannel]), aperture, 0.03 * aperture);
  EXPECT_NEAR(std::arg(-s[kHhChannel] / s[kVvChannel]), 0, 0.1);
}

}  // namespace
}  // namespace seaglint

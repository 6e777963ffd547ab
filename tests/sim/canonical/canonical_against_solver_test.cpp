// SPDX-License-Identifier: BSD-3-Clause
// Targets with known echoes: closed forms, the Mie series, and a full-wave trihedral.
#include <gtest/gtest.h>

#include <vector>

#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

constexpr double kRounding = 1e-9;  // relative; double arithmetic on a few thousand terms
const double k16 = wavenumber(16e9);

TEST(Plate, IsMinusJAreaOverWavelengthAtNormalIncidence) {
  for (const auto& [length, width] : {std::pair{0.5, 0.3}, {0.05, 0.05}, {10.0, 2.0}}) {
    for (const double min_patch_m : {7e-5, 7e-4, 0.02, 1.4}) {
      if (length / min_patch_m > 28000) continue;  // much finer than the plate needs
      const auto s = echo(make_plate(length, width), Vec3::UnitX(), k16, min_patch_m);
      const Complex expected(0, -length * width * k16 / (2 * kPi));
      EXPECT_LT(std::abs(s[kHhChannel] - expected), kRounding * std::abs(expected))
          << length << " x " << width << " at " << min_patch_m;
      EXPECT_LT(std::abs(s[kVvChannel] - expected), kRounding * std::abs(expected));
      EXPECT_LT(std::abs(s[kHvChannel]), kRounding * std::abs(expected));
    }
  }
}

// Physical optics of a rectangular plate in the plane of its length (Balanis, Advanced Engineering Electromagnetics,
// example 11-3): S = -j A cos(theta) / lambda sin(X)/X, X = k L sin(theta), equal for both polarisations.
TEST(Plate, FollowsThePhysicalOpticsLobesForAnySmallestPatch) {
  const double length = 0.2667, width = 0.1524, k = wavenumber(10.24e9);
  const Scatterer plate(make_plate(length, width));
  for (const double min_patch_m : {2e-4, 3.5e-3, 0.07}) {
    for (double theta_deg = 0.5; theta_deg < 80; theta_deg += 1.37) {
      const double theta = radians(theta_deg), x = k * length * std::sin(theta);
      const Complex expected(0, -length * width * std::cos(theta) * k / (2 * kPi) * std::sin(x) / x);
      const auto s = echo(plate, radar_basis(direction(theta_deg, 0)), k, min_patch_m);
      EXPECT_LT(std::abs(s[kVvChannel] - expected), kRounding * length * width * k) << theta_deg;
      EXPECT_LT(std::abs(s[kHhChannel] - expected), kRounding * length * width * k) << theta_deg;
    }
  }
}

TEST(Plate, ScattersFromBothSides) {
  const auto front = echo(make_plate(0.3, 0.2), direction(10, 5), k16);
  const auto back = echo(make_plate(0.3, 0.2), direction(190, -5), k16);
  EXPECT_LT(std::abs(front[kVvChannel] - back[kVvChannel]), kRounding * std::abs(front[kVvChannel]) + 1e-12);
}

// A dihedral viewed along its bisector returns the whole wave after two bounces: aperture sqrt(2) a b; its first-bounce
// lobes at 45 deg off each face vanish here, as k a sin(45 deg) is far out in their side lobes. Seam along z: S_hh =
// -S_vv (CONVENTIONS.md).
TEST(Dihedral, HasOppositeSignsForHhAndVvAndTheApertureFormulasStrength) {
  const double a = 0.3, b = 0.25;
  const auto s = echo(make_dihedral(b, a, kPi / 2), Vec3::UnitX(), k16);
  const double expected = std::sqrt(2.0) * a * b * k16 / (2 * kPi);  // |S| = A / lambda
  // First-bounce side lobes: each face contributes at most A cos45 / (lambda k a sin45).
  const double side_lobe = 2 * a * b * k16 / (2 * kPi) / (k16 * a);
  EXPECT_NEAR(std::abs(s[kHhChannel]), expected, side_lobe);
  EXPECT_LT(std::abs(s[kHhChannel] + s[kVvChannel]), 2 * side_lobe);
  EXPECT_LT(std::abs(s[kHvChannel]), kRounding * expected);
  EXPECT_NEAR(10 * std::log10(std::norm(s[kVvChannel]) / (expected * expected)), 0, 0.1);
}

TEST(Dihedral, RotatedBy45DegreesIsPureCrossPolarised) {
  const TriangleMesh rotated =
      transformed(make_dihedral(0.25, 0.3, kPi / 2), axis_rotation(kPi / 4, Vec3::UnitX()), Vec3::Zero());
  const auto s = echo(rotated, Vec3::UnitX(), k16);
  const double expected = std::sqrt(2.0) * 0.3 * 0.25 * k16 / (2 * kPi);
  const double side_lobe = 2 * 0.3 * 0.25 * k16 / (2 * kPi) / (k16 * 0.3);
  EXPECT_NEAR(std::abs(s[kHvChannel]), expected, side_lobe);
  EXPECT_LT(std::abs(s[kHhChannel]), side_lobe);
  EXPECT_LT(std::abs(s[kVvChannel]), side_lobe);
}

// Peak of the triangular trihedral on its axis, 4 pi leg^4 / (3 lambda^2) (Knott, Shaeffer and Tuley, Radar Cross
// Section, table 6.1).
TEST(TrihedralFacets, ReachesItsPeakOnItsAxis) {
  const double leg = 0.372;
  const auto s = echo(make_triangular_trihedral(leg), Vec3(1, 1, 1).normalized(), k16);
  const double peak = 10 * std::log10(4 * kPi * std::pow(leg, 4) / 3 * std::pow(k16 / (2 * kPi), 2));
  EXPECT_NEAR(peak, 23.6, 0.05);
  record_figure(dbsm(s[kVvChannel]), 2, "trihedral_peak_dbsm");
  // First- and second-bounce lobes add at most their edges' sum, below 2 % of the amplitude at k leg = 125.
  EXPECT_NEAR(dbsm(s[kVvChannel]), peak, 0.17);
  EXPECT_NEAR(dbsm(s[kHhChannel]), peak, 0.17);
}

TEST(TrihedralFacets, IsWithinPhysicalOpticsReachOfTheFullWaveSolution) {
  const Scatterer trihedral(make_triangular_trihedral(4));
  double squares = 0;
  int count = 0;
  for (const auto& row : read_csv("trihedral_fdtd.csv")) {
    const double azimuth = std::stod(row[0]), f_rel = std::stod(row[2]);
    const Complex full_wave(std::stod(row[9]), std::stod(row[10]));
    const auto s = echo(trihedral, radar_basis(direction(45 + azimuth, 35.264389682754654)), 2 * kPi * f_rel);
    const Complex ours = s[row[1] == "V" ? kVvChannel : kHhChannel];
    const double difference = dbsm(ours) - dbsm(full_wave);
    // The reference's 0.3 dB and 10 deg, and the edge diffraction that physical optics neglects at 4-5 wavelengths:
    // about 1/(k leg) = 4 % each from three free edges and three seams, at most 1 dB and 8 deg.
    EXPECT_NEAR(difference, 0, 1.3) << azimuth << " deg " << row[1] << " f_rel " << f_rel;
    EXPECT_NEAR(degrees(std::arg(ours / full_wave)), 0, 18) << azimuth << " deg " << row[1] << " f_rel " << f_rel;
    squares += difference * difference;
    ++count;
  }
  const double rms = std::sqrt(squares / count);
  RecordProperty("rms_db", std::to_string(rms));
  EXPECT_LT(rms, 0.65) << "physical optics at every bounce has 0.5-0.6 dB";
}

TEST(Sphere, FollowsTheMieSeries) {
  // 20,480 facets: the chord lies edge^2 / (12 R) inside the sphere on average, which at ka 150 is 1.7 deg of two-way
  // phase and 0.01 dB; the shadow boundary's end point contributes 1 / (2 ka) (0.09 dB at ka 64 once rounded up by the
  // facets along it).
  const Scatterer sphere(make_sphere(1, 5));
  for (const auto& row : read_csv("mie_sphere.csv")) {
    const double ka = std::stod(row[0]);
    const Complex mie(std::stod(row[1]), std::stod(row[2]));
    const auto s = echo(sphere, radar_basis(direction(23, 11)), ka, 1.4e-3);
    EXPECT_NEAR(dbsm(s[kVvChannel]) - dbsm(mie), 0, 0.25) << ka;
    EXPECT_NEAR(degrees(std::arg(s[kHhChannel] / mie)), 0, 4) << ka;
  }
}

// Broadside of a cylinder: |S| = L sqrt(ka) / (2 sqrt(pi)), sigma = k a L^2.
TEST(Cylinder, FlashesAtBroadside) {
  const double radius = 0.5, height = 1.2, k = wavenumber(3e9);
  const auto s = echo(make_cylinder(radius, height, 720), Vec3::UnitX(), k, 7e-4);
  EXPECT_NEAR(dbsm(s[kVvChannel]), 10 * std::log10(k * radius * height * height), 0.3);
}

// Right-angled trihedrals in the faces of an icosahedron: one viewed along its axis gives its peak, plus or minus the
// contribution of the five cells around it (41.8 deg away and more, each at least 6 dB down in its own pattern).
TEST(IcosahedralReflector, ReturnsATrihedralsPeakFaceOn) {
  const Scatterer reflector(make_icosahedral_reflector());
  const double leg = kReflectorEdge / std::sqrt(2.0);
  const double peak = 10 * std::log10(4 * kPi * std::pow(leg, 4) / 3 * std::pow(k16 / (2 * kPi), 2));
  EXPECT_NEAR(dbsm(echo(reflector, radar_basis(Vec3::UnitX()), k16, 7e-4)[kVvChannel]), peak, 1);
}

// Mean over the sphere -1.68 dB and median -1.31 dB of the peak (geometrical optics, all visible cells); medians over 2
// deg because several cells interfere.
TEST(IcosahedralReflector, HasTheMeanOfGeometricalOpticsOverAllDirections) {
  const Scatterer reflector(make_icosahedral_reflector());
  const double leg = kReflectorEdge / std::sqrt(2.0);
  const double peak = 4 * kPi * std::pow(leg, 4) / 3 * std::pow(k16 / (2 * kPi), 2);
  double sum = 0;
  int count = 0;
  // A Fibonacci lattice covers the sphere evenly.
  constexpr int kDirections = 1500;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1 - (2 * i + 1.0) / kDirections, azimuth = 2.399963229728653 * i;
    const Vec3 r(std::sqrt(1 - z * z) * std::cos(azimuth), std::sqrt(1 - z * z) * std::sin(azimuth), z);
    sum += 4 * kPi * std::norm(echo(reflector, radar_basis(r), k16, 1.4e-3)[kVvChannel]);
    ++count;
  }
  const double mean_db = 10 * std::log10(sum / count / peak);
  RecordProperty("mean_db", std::to_string(mean_db));
  // Speckle of 1500 samples: 0.11 dB one sigma, three of them; single and double bounces add to the triple ones that
  // the figure counts.
  EXPECT_NEAR(mean_db, -1.68, 0.8);
}

}  // namespace
}  // namespace seaglint

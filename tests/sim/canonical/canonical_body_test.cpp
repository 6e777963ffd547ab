// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sim/canonical/canonical_body.h"
#include "sim/canonical/point_response.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/observation/observation.h"
#include "tests/measured.h"
#include "tests/sim/scattering/moving_radar.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;
using namespace testing_moving_radar;

// Bodies that are recognised from their mesh, and those that are none of them.

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

// Targets with known echoes: closed forms, the Mie series, and a full-wave trihedral.

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

// Ideal points against CONVENTIONS.md, written out term by term.

IntervalSampling two_pulses() {
  IntervalSampling sampling;
  sampling.first_hz = 15.99e9;
  sampling.step_hz = 0.7e6;
  sampling.count = 300;
  sampling.frequencies_per_pulse = 100;
  sampling.pulse_first = {0, 200};
  sampling.pulse_time_s = {7.0, 7.05};
  return sampling;
}

// 30,000 rad of phase carry 30,000 eps = 7e-12; the renewed products add 32 eps.
constexpr double kPhaseRounding = 2e-11;

TEST(PointResponse, APointNearerToTheRadarIsAdvancedInPhase) {
  const IntervalSampling sampling = two_pulses();
  const Vec3 r_hat = direction_to_radar(radians(0), radians(0));
  const PointSpec nearer{{3, 0, 0}, 2.5, {0, 0, 0}};
  const FrequencyResponse response = point_response({&nearer, 1}, r_hat, sampling);
  ASSERT_EQ(response.values.size(), 200u);
  for (int b = 0; b < 100; ++b) {
    const double k = 2 * kPi * (sampling.first_hz + (200 + b) * sampling.step_hz) / kSpeedOfLight;
    EXPECT_NEAR(std::abs(response.at(1, b) - std::polar(2.5, 2 * k * 3)), 0, 2.5 * kPhaseRounding);
  }
}

TEST(PointResponse, AVelocityAwayFromTheRadarDelaysLaterPulses) {
  const IntervalSampling sampling = two_pulses();
  const Vec3 r_hat = direction_to_radar(radians(90), radians(0));
  const PointSpec receding{{10, 0, 0}, 1, {0, -4, 0}};
  const FrequencyResponse response = point_response({&receding, 1}, r_hat, sampling);
  const double range_m = 4 * (7.05 - 7.0);
  for (int b = 0; b < 100; ++b) {
    EXPECT_NEAR(std::abs(response.at(0, b) - Complex(1)), 0, kPhaseRounding);
    const double f = sampling.first_hz + (200 + b) * sampling.step_hz;
    EXPECT_NEAR(std::abs(response.at(1, b) - std::polar(1.0, -4 * kPi * f * range_m / kSpeedOfLight)), 0,
                kPhaseRounding);
  }
}

TEST(PointResponse, AChirpReachesThePointAtTheTimeOfEachFrequency) {
  IntervalSampling sampling = two_pulses();
  sampling.chirp_rate_hz_s = 70e6 / 36e-6;
  const Vec3 r_hat = direction_to_radar(radians(180), radians(0));
  const PointSpec receding{{5, 0, 0}, 1, {12, 0, 0}};
  const FrequencyResponse response = point_response({&receding, 1}, r_hat, sampling);
  for (int n = 0; n < 2; ++n) {
    for (int b = 0; b < 100; ++b) {
      const double baseband = (b - 49.5) * sampling.step_hz;
      const double f = sampling.first_hz + (sampling.pulse_first[n] + b) * sampling.step_hz;
      const double range_m = 5 + 12 * (sampling.pulse_time_s[n] - 7.0 + baseband / sampling.chirp_rate_hz_s);
      EXPECT_NEAR(std::abs(response.at(n, b) - std::polar(1.0, -4 * kPi * f * range_m / kSpeedOfLight)), 0,
                  kPhaseRounding);
    }
  }
}

TEST(PointResponse, DirectionsAreCounterClockwiseFromTheBowAndUpwards) {
  EXPECT_NEAR((direction_to_radar(radians(0), radians(0)) - Vec3(1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((direction_to_radar(radians(90), radians(0)) - Vec3(0, 1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((direction_to_radar(radians(30), radians(90)) - Vec3(0, 0, 1)).norm(), 0, 1e-15);
}

TEST(FrequencyResponse, AddsTermByTermAndRefusesOtherShapes) {
  FrequencyResponse a{1, 2, {Complex(1, 2), Complex(3, 4)}};
  const FrequencyResponse b{1, 2, {Complex(10, 0), Complex(0, 10)}};
  a += b;
  EXPECT_EQ(a.values[0], Complex(11, 2));
  EXPECT_EQ(a.values[1], Complex(3, 14));
  const FrequencyResponse other{2, 1, {Complex(), Complex()}};
  EXPECT_THROW(a += other, std::exception);
}

TEST(PointResponse, OverTheSeaIsTheProductOfTwoPaths) {
  PointSpec point;
  point.position_m = {3, -2, 4.5};
  point.amplitude_m = 2;
  IntervalSampling sampling;
  sampling.first_hz = 16e9;
  sampling.step_hz = 1e6;
  sampling.count = sampling.frequencies_per_pulse = 8;
  sampling.pulse_first = {0};
  sampling.pulse_time_s = {0};
  const Vec3 r = direction_to_radar(radians(20), radians(3)), x(3, -2, 4.5);
  const SeaReflection sea(SeaReflectionSpec{}, 0.5);
  const FrequencyResponse response = point_response_over_sea(std::array{point}, r, sampling, Polarisation::kHv, sea);
  for (int b = 0; b < 8; ++b) {
    const double k = 2 * kPi * (16e9 + 1e6 * b) / kSpeedOfLight;
    const SeaReflectionCoefficients rho = sea.at(k, r.z());
    const auto path = [&](const Complex& c) {
      return std::polar(1.0, k * r.dot(x)) + c * std::polar(1.0, k * image_direction(r).dot(x));
    };
    EXPECT_LT(std::abs(response.at(0, b) - 2.0 * path(rho.h) * path(rho.v)), 1e-9) << b;
  }
}

// A moving radar: the directions to it and to its image in the sea change with its relative motion.

TEST(PointResponse, HasTheRangeOfTheRadarsPath) {
  const IntervalSampling sampling = interval();
  const Vec3 r_hat = direction_to_radar(radians(30), radians(3)), x(25, -40, 12);
  const PointSpec point{{x.x(), x.y(), x.z()}, 1, {0, 0, 0}};
  const FrequencyResponse response = point_response({&point, 1}, r_hat, sampling);
  const auto range_beyond_reference = [&](double t) {
    const Vec3 radar = kRange * r_hat + kVelocity * t;
    return (radar - x).norm() - radar.norm();
  };
  for (std::size_t n = 0; n < sampling.pulse_time_s.size(); ++n) {
    const double t = sampling.pulse_time_s[n] - sampling.pulse_time_s.front();
    const double k = 2 * kPi * (sampling.first_hz + 7 * sampling.step_hz) / kSpeedOfLight;
    const double moved_m = range_beyond_reference(t) - range_beyond_reference(0);
    const double phase = std::arg(response.at(static_cast<int>(n), 7) / response.at(0, 7));
    // Neglected: the change of the wavefront's curvature x^2 / (2 R) with the direction, below x^2 u t / R^2.
    const double curvature_m = x.squaredNorm() * kVelocity.norm() * t / (kRange * kRange);
    EXPECT_NEAR(std::remainder(phase + 2 * k * moved_m, 2 * kPi), 0, 2 * k * curvature_m + 1e-9);
    if (n > 8) {
      EXPECT_GT(std::abs(2 * k * moved_m), 0.5);
    }
  }
}

TEST(PointResponse, OverTheSeaHasFourPathsPerPulseDirection) {
  const Vec3 r_hat = direction_to_radar(radians(10), radians(5)), x(25, -40, 12), v(3, -2, 1);
  const PointSpec point{{x.x(), x.y(), x.z()}, 1, {v.x(), v.y(), v.z()}};
  const SeaReflection sea = rough_water();
  for (const Vec3& velocity : kVelocities) {
    const IntervalSampling sampling = over_the_sea(velocity);
    const FrequencyResponse response = point_response_over_sea({&point, 1}, r_hat, sampling, Polarisation::kHv, sea);
    RelativeError error;
    for (std::size_t n = 0; n < sampling.pulse_time_s.size(); ++n) {
      const Vec3 r = direction_at(sampling, r_hat, n), image(r.x(), r.y(), -r.z());
      const Vec3 now = x + (sampling.pulse_time_s[n] - sampling.pulse_time_s.front()) * v;
      for (int b = 0; b < sampling.frequencies_per_pulse; ++b) {
        const double k = 2 * kPi * (sampling.first_hz + b * sampling.step_hz) / kSpeedOfLight;
        const SeaReflectionCoefficients rho = sea.at(k, r.z());
        const auto path = [&](const Complex& c) {
          return std::polar(1.0, k * r.dot(now)) + c * std::polar(1.0, k * image.dot(now));
        };
        error.add(response.at(static_cast<int>(n), b), path(rho.h) * path(rho.v));
      }
    }
    // Rounding of directions (1e-16) times phases of 2 k |x|, 3e4 rad.
    EXPECT_LT(error.value(), 1e-10) << velocity.x() << ' ' << velocity.y() << ' ' << velocity.z();
  }
}

}  // namespace
}  // namespace seaglint

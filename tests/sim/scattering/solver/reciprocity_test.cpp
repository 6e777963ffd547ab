// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/observation/observation.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Reciprocity of scattering matrices and of their contributions: one antenna, over the sea.

constexpr double kReciprocityRounding = 1e-12;
const std::array kBand{2 * kPi * 0.95, 2 * kPi, 2 * kPi * 1.05};

// A house on a hull, turned so that no face is along an axis: many bounces, large cross-polarisation.
const Scatterer& turned_ship() {
  static const Scatterer ship(transformed(block_ship(), axis_rotation(0.4, Vec3(1, 2, -0.5).normalized()), {3, -1, 2}));
  return ship;
}

double distance(const std::array<Complex, 4>& a, const std::array<Complex, 4>& b) {
  double sum = 0;
  for (int i = 0; i < 4; ++i) sum += std::norm(a[i] - b[i]);
  return std::sqrt(sum);
}

TEST(Reciprocity, OneAntennaHasEqualCrossPolarisations) {
  double one_way = 0, cross = 0;
  for (const double azimuth : {12.0, 33.0, 71.0, 130.0}) {
    const std::array view{monostatic(radar_basis(direction(azimuth, 17)))};
    const auto echoes = scattering_matrices(turned_ship(), view, kBand, {})[0];
    const auto from_transmitter = one_way_matrices(turned_ship(), view, kBand, {})[0];
    for (std::size_t q = 0; q < kBand.size(); ++q) {
      EXPECT_EQ(echoes[q][kHvChannel], echoes[q][kVhChannel]) << azimuth;
      EXPECT_EQ(echoes[q][kHhChannel], from_transmitter[q][kHhChannel]) << azimuth;
      one_way += std::norm(from_transmitter[q][kHvChannel] - from_transmitter[q][kVhChannel]);
      cross += std::norm(echoes[q][kHvChannel]);
    }
  }
  std::printf("one antenna: |hv - vh| of the beams alone %.3f of hv\n", std::sqrt(one_way / cross));
  EXPECT_GT(one_way, 0.01 * cross);  // else the first check would hold without the mean
}

TEST(Reciprocity, ExchangedPairsAreFound) {
  const RadarBasis a = radar_basis(direction(33, 17)), b = radar_basis(direction(60, 8)),
                   c = radar_basis(direction(20, 10));
  const std::array pairs{bistatic(a, b), monostatic(a), bistatic(b, a), bistatic(a, c)};
  EXPECT_EQ(exchanged_pair(pairs, 0), 2);
  EXPECT_EQ(exchanged_pair(pairs, 1), 1);
  EXPECT_EQ(exchanged_pair(pairs, 2), 0);
  EXPECT_EQ(exchanged_pair(pairs, 3), std::nullopt);
}

TEST(Reciprocity, PointsOfAViewSumToItsMatrix) {
  const RadarBasis a = radar_basis(direction(33, 17)), b = radar_basis(direction(60, 8));
  for (const BistaticGeometry& geometry : {monostatic(a), bistatic(a, b)}) {
    const ViewResult view = points_of(turned_ship(), geometry, kBand[1], 1e-3, {});
    const auto matrix = scattering_matrices(turned_ship(), geometry, {&kBand[1], 1}, {})[0];
    EXPECT_LT(distance(view.matrices[0], matrix), kReciprocityRounding * largest(matrix));
    const auto sum = direct_sum(view.points, kBand[1], Vec3::Zero());
    EXPECT_LT(distance(sum, view.matrices[0]), kReciprocityRounding * largest(view.matrices[0]));
  }
}

// The groove of grooves.py: two arms of 3 wavelengths at this angle, 0.4 thick and 3 high, open towards azimuth 0.
TriangleMesh groove(double angle_deg) {
  const double half = radians(angle_deg / 2);
  const Vec2 end = 3 * Vec2(std::cos(half), std::sin(half)), back = end + 0.4 * Vec2(-std::sin(half), std::cos(half));
  return prism({{0, 0}, end, back, {-0.4 / std::sin(half), 0}, {back.x(), -back.y()}, {end.x(), -end.y()}}, 3);
}

// Cross-polarised echo of grooves off their axis, where beams leave them in other directions than they came from: hv
// and vh from the transmitter, one of which is zero by physical optics alone, and their mean against integral
// equations. It is predicted as to its order only. The squared error of the mean is the mean of both squares less |hv -
// vh|^2 / 4: over all grooves a quarter less at least.
TEST(Reciprocity, MeanOfBothSensesIsNearerThanTheirAverage) {
  // Largest error of the mean relative to the exact value, by angle and elevation.
  const std::map<std::pair<double, double>, double> reached{{{25, 5}, 1.48}, {{25, 15}, 1.14}, {{25, 30}, 1.99},
                                                            {{80, 5}, 1.03}, {{80, 15}, 0.82}, {{80, 30}, 0.59}};
  std::map<std::pair<double, double>, std::array<double, 4>> sums;  // errors of hv, vh, mean; power of the exact hv
  for (const double angle : {25.0, 80.0}) {
    const Scatterer body(groove(angle));
    for (const auto& row : read_csv("grooves.csv")) {
      if (std::stod(row[0]) != angle) continue;
      const std::array view{monostatic(radar_basis(direction(std::stod(row[1]), std::stod(row[2]))))};
      const auto s = one_way_matrices(body, view, std::array{2 * kPi}, {7e-5, 12, true})[0][0];
      const Complex exact(std::stod(row[5]), std::stod(row[6]));
      auto& sum = sums[{angle, std::stod(row[2])}];
      sum[0] += std::norm(s[kHvChannel] - exact);
      sum[1] += std::norm(s[kVhChannel] - exact);
      sum[2] += std::norm(0.5 * (s[kHvChannel] + s[kVhChannel]) - exact);
      sum[3] += std::norm(exact);
    }
  }
  ASSERT_EQ(sums.size(), 6);
  double all_hv = 0, all_vh = 0, all_mean = 0;
  for (const auto& [place, sum] : sums) {
    const auto relative = [&sum = sum](int i) { return std::sqrt(sum[i] / sum[3]); };
    std::printf("groove of %g deg, elevation %g deg: error of hv %.2f, of vh %.2f, of their mean %.2f of it\n",
                place.first, place.second, relative(0), relative(1), relative(2));
    constexpr double kLastDigit = 0.01;  // of the figures above
    EXPECT_LT(relative(2), reached.at(place) + kLastDigit) << place.first << ' ' << place.second;
    all_hv += sum[0];
    all_vh += sum[1];
    all_mean += sum[2];
  }
  EXPECT_LT(all_mean, 0.75 * 0.5 * (all_hv + all_vh));
}

TEST(Reciprocity, TheEstimateIsHalfOfTheDifferenceOfTheBeams) {
  const Scatterer body(groove(80));
  const TracingSettings settings{7e-5, 12, false};
  const std::array view{monostatic(radar_basis(direction(20, 15)))};
  const ViewEstimate estimate = *points_of(body, view[0], kBand[1], 0, settings).estimate;
  const auto s = one_way_matrices(body, view, {&kBand[1], 1}, settings)[0][0];
  EXPECT_GT(std::abs(s[kHvChannel] - s[kVhChannel]), 0.1);
  EXPECT_LT(std::abs(estimate.all().non_reciprocal - 0.5 * (s[kHvChannel] - s[kVhChannel])), 1e-9);

  // Over a conducting sea hv and vh of the image have the factor -1, and the mixed paths do not count.
  SeaReflectionSpec spec;
  spec.surface = SeaSurface::kConductor;
  const double height = 2.3, k = kBand[1];
  SolveRequest request = over_sea_request(body, view[0].receive.r, {SeaReflection(spec, 0), height}, {&k, 1}, settings);
  request.estimates = true;
  const ViewEstimate over_sea = *solve(request).views[0].estimate;
  const std::array image{monostatic(image_basis(view[0].receive))};
  const auto of_image = one_way_matrices(body, image, {&k, 1}, settings)[0][0];
  const Complex detour = std::polar(1.0, -4 * k * height * view[0].receive.r.z());
  const Complex expected =
      0.5 * (s[kHvChannel] - s[kVhChannel]) - 0.5 * detour * (of_image[kHvChannel] - of_image[kVhChannel]);
  EXPECT_LT(std::abs(over_sea.all().non_reciprocal - expected), 1e-9);
}

TEST(Reciprocity, HoldsOverTheSea) {
  SeaReflectionSpec spec;
  spec.enabled = true;
  const SeaReflection sea(spec, 0.3);
  for (const double azimuth : {12.0, 71.0}) {
    const auto s = matrices_over_sea(Scatterer(block_ship()), direction(azimuth, 17), {sea, 1.5}, kBand, {});
    for (std::size_t q = 0; q < kBand.size(); ++q)
      EXPECT_LT(std::abs(s[q][kHvChannel] - s[q][kVhChannel]), kReciprocityRounding * largest(s[q])) << azimuth;
  }
}

// Separate transmit and receive directions.

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

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <utility>

#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/solver/solve.h"
#include "tests/measured.h"
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
    const Vec3 r_t = direction(0, 60), r_s = direction(azimuth, 40), both = r_t + r_s;
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
      const double r = (i + 0.5) / rings * side, arc = r <= height ? kPi / 6 : kPi / 6 - std::acos(height / r);
      sum += 12 * r * arc * std::polar(1.0, -k * r * r / range_m) * (side / rings);
    }
    const double expected = k / (2 * kPi) * std::abs(sum);
    fmt::print("trihedral at {} m: {:.4f} of {:.4f} m, {:.4f} m far away\n", range_m, std::abs(s[kHhChannel]), expected,
               k / (2 * kPi) * leg * leg / std::numbers::sqrt3);
    EXPECT_NEAR(std::abs(s[kHhChannel]) / expected, 1, 0.005) << range_m;
    // In an interval, at rest, with the few other bounces. A piece is a point at its centroid, which leaves out the
    // mean of its own second order, and the two decompositions cut differently: 0.011 rad at most from 20 m to 1000 m,
    // and a quarter of it where pieces end at half of their largest phase.
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
    RelativeError error;
    for (std::size_t i = 0; i < near.response.values.size(); ++i)
      error.add(far.response.values[i], near.response.values[i]);
    // Positions of the centre are rounded by 1e-13 m, at k = 335 / m.
    EXPECT_LT(error.value(), kRounding) << range_m;
  }
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Specular sea reflection: image theory, the four paths in closed form, and the response over an interval.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sim/core/numbers/random.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/observation/sea_reflection.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

const double k16 = wavenumber(16e9);

SeaReflection conductor() {
  SeaReflectionSpec spec;
  spec.surface = SeaSurface::kConductor;
  return SeaReflection(spec, 0);
}

std::array<Complex, 4> over_sea(const Scatterer& scatterer, const Vec3& r_hat, double height, const SeaReflection& sea,
                                double k, double min_patch_m = 0) {
  return matrices_over_sea(scatterer, r_hat, {sea, height}, std::array{k}, {min_patch_m, 8})[0];
}

// A sphere 10 m ahead of the origin and 10 m up, the radar some km from the water below the origin: the sum over the
// four paths by their lengths.
TEST(SeaReflection, RefersTheRangeToTheWaterBelow) {
  const double k = wavenumber(10e9), radius = 0.1, height = 10, el = radians(5);
  const Vec3 r = direction(0, 5);
  const Scatterer sphere(transformed(make_sphere(radius, 4), Mat3::Identity(), {10, 0, 0}));
  const Complex alone = echo(make_sphere(radius, 4), r, k)[kHhChannel];
  for (const double range_m : {5e3, 20e3}) {
    const Vec3 radar(range_m * std::cos(el), 0, range_m * std::sin(el)), centre(10, 0, height), image(10, 0, -height);
    Complex sum = 0;
    for (const Vec3& outbound : {centre, image}) {
      for (const Vec3& inbound : {centre, image}) {
        const Vec3 a = radar - outbound, b = radar - inbound;
        // Towards the image the wave is incident from below.
        const auto up = [&](const Vec3& path, const Vec3& point) {
          return Vec3(path.x(), path.y(), point == image ? -path.z() : path.z()).normalized();
        };
        const double front = radius * ((up(a, outbound) + up(b, inbound)).norm() - 2);
        const double sign = (outbound == image ? -1 : 1) * (inbound == image ? -1 : 1);
        sum += sign * alone * std::polar(1.0, -k * (a.norm() + b.norm() - 2 * range_m) + k * front);
      }
    }
    sum *= std::polar(1.0, -2 * k * r.z() * height);  // phases are about the body's origin
    SolveRequest request = over_sea_request(sphere, r, {conductor(), height}, std::array{k}, {});
    request.radar.range_m = range_m;
    const Complex ours = matrices_of(request)[0][0][kHhChannel];
    // Of 4 |alone|, the sum of the four paths: 2 % for the echo of a sphere 10 deg off, and the third order of the
    // path, k X H^2 / R^2 = 0.01 rad at 5 km.
    EXPECT_LT(std::abs(ours - sum), 0.03 * 4 * std::abs(alone)) << range_m;
  }
}

TEST(SeaReflection, SeaWaterHasFresnelsCoefficientsAndAPseudoBrewsterAngle) {
  const SeaReflection sea(SeaReflectionSpec{}, 0);
  // Fresnel's formulas for the permittivity itself (Born and Wolf, 1.5.2, eqs. 21 and 21a).
  const Complex index = std::sqrt(sea_water_permittivity(16e9, 20, 35));
  double min = 1, least_at = 0;
  for (double psi = 0.1; psi < 89; psi += 0.1) {
    const Complex i = radians(90 - psi), t = std::asin(std::sin(i) / index);
    const SeaReflectionCoefficients rho = sea.at(k16, std::sin(radians(psi)));
    EXPECT_LT(std::abs(rho.h + std::sin(i - t) / std::sin(i + t)), 1e-12) << psi;
    EXPECT_LT(std::abs(rho.v - std::tan(i - t) / std::tan(i + t)), 1e-12) << psi;
    if (std::abs(rho.v) < min) {
      min = std::abs(rho.v);
      least_at = psi;
    }
  }
  RecordProperty("pseudo_brewster_deg", std::to_string(least_at));
  // |sin psi| = |eps|^{-1/2} within a few tenths of a degree: 7.6 deg.
  EXPECT_NEAR(least_at, degrees(std::asin(1 / std::sqrt(std::abs(index * index)))), 0.3);
  // At grazing both polarisations tend to -1 in the same convention: rho_h = rho_v = -1.
  EXPECT_LT(std::abs(sea.at(k16, 1e-5).v + 1.0), 1e-3);
  EXPECT_LT(std::abs(sea.at(k16, 1e-5).h + 1.0), 1e-3);
}

// A small sphere at height H: all four echoes are S0 = -(a/2) e^{j2ka}-like, the bistatic ones (by 2 el) nearly so.
// Then S = S0 (1 + rho e^{-j 2 k H sin el})^2 about the sphere.
TEST(SeaReflection, SphereAboveTheSeaHasFourPathInterference) {
  const double radius = 0.05, el = radians(1.2), k = wavenumber(10e9);
  const Scatterer sphere(make_sphere(radius, 4));
  const auto alone = echo(sphere, radar_basis(direction(15, 1.2)), k, 7e-5);
  const double half = kPi / (k * std::sin(el));  // height from null to null, m
  double max_error = 0;
  for (const double height : {0.25, 0.5, 0.75, 1.0, 1.3, 2.5}) {
    const auto s = over_sea(sphere, direction(15, 1.2), height * half, conductor(), k, 7e-5);
    const Complex e = std::polar(1.0, -2 * k * height * half * std::sin(el));
    // The bistatic angle of 2.4 deg moves the specular point: psi = 2 a cos(1.2 deg) is 2 a 2.2e-4 shorter, 0.005 rad
    // on two paths; the facets of the tessellation scatter equally within 2 %.
    max_error = std::max(
        {max_error, std::abs(s[kHhChannel] - (1.0 - e) * (1.0 - e) * alone[kHhChannel]) / std::abs(alone[kHhChannel]),
         std::abs(s[kVvChannel] - (1.0 + e) * (1.0 + e) * alone[kVvChannel]) / std::abs(alone[kVvChannel])});
    EXPECT_LT(std::abs(s[kHhChannel] - (1.0 - e) * (1.0 - e) * alone[kHhChannel]), 0.03 * std::abs(alone[kHhChannel]))
        << height;
    EXPECT_LT(std::abs(s[kVvChannel] - (1.0 + e) * (1.0 + e) * alone[kVvChannel]), 0.03 * std::abs(alone[kVvChannel]))
        << height;
  }
  fmt::print("sphere over the sea: within {:.4f} of its echo\n", max_error);
  record_figure(100 * max_error, 1, "sea_sphere_percent");
  // Positions of nulls and peaks: hh vanishes at whole multiples of half, vv at odd halves; peaks are 12 dB up.
  EXPECT_LT(std::abs(over_sea(sphere, direction(15, 1.2), half, conductor(), k, 7e-5)[kHhChannel]),
            0.05 * std::abs(alone[kHhChannel]));
  EXPECT_NEAR(
      dbsm(over_sea(sphere, direction(15, 1.2), half, conductor(), k, 7e-5)[kVvChannel]) - dbsm(alone[kVvChannel]),
      12.04, 0.2);
}

TEST(SeaReflection, RoughnessRemovesTheInterference) {
  const double k = k16, el = radians(2);
  const Scatterer sphere(make_sphere(0.05, 4));
  const double height = kPi / (2 * k * std::sin(el));  // peak of hh over a smooth sea
  const auto level = [&](double wave_height) {
    return std::abs(over_sea(sphere, direction(0, 2), height, SeaReflection(SeaReflectionSpec{}, wave_height), k,
                             0.001)[kHhChannel]);
  };
  const double alone = std::abs(echo(sphere, radar_basis(direction(0, 2)), k, 7e-5)[kHhChannel]);
  const auto expected = [&](double wave_height) {
    const Complex rho = SeaReflection(SeaReflectionSpec{}, wave_height).at(k, std::sin(el)).h;
    return std::norm(1.0 - rho) * alone;
  };
  for (const double wave_height : {0.0, 0.2, 1.0, 3.0})
    EXPECT_NEAR(level(wave_height), expected(wave_height), 0.05 * alone) << wave_height;
  EXPECT_GT(level(0), 3.8 * alone);
  EXPECT_LT(level(3), 1.1 * alone);
}

// A vertical plate on a conducting sea is, by image theory, a plate of twice the height illuminated by the radar and
// its image (odd for h, even for v): S_pp = S2(r, r) + rho_p S2(r', r) with S2 of the doubled plate; S2(r', r) is its
// specular reflection, 2 A cos(el) / lambda: the dihedral's echo.
TEST(SeaReflection, PlateOnAConductingSeaIsADihedral) {
  const double width = 0.3, height = 0.2;
  const auto vertical_plate = [&](double from, double to) {
    TriangleMesh mesh = make_plate(width, to - from);
    for (Vec3& x : mesh.vertices) x.z() += 0.5 * (from + to);
    return mesh;
  };
  const Scatterer plate(vertical_plate(0, height)), doubled(vertical_plate(-height, height));
  for (const double elevation : {2.0, 10.0, 35.0}) {
    const Vec3 r = direction(0, elevation);
    const auto s = over_sea(plate, r, 0, conductor(), k16);
    const auto direct = echo(doubled, radar_basis(r), k16);
    const RadarBasis basis = radar_basis(r), image = radar_basis(image_direction(r));
    const auto mirrored = scattering_matrices(doubled, bistatic(basis, image), std::array{k16}, {0, 8})[0];
    const double dihedral = 2 * width * height * std::cos(radians(elevation)) * k16 / (2 * kPi);
    EXPECT_NEAR(std::abs(mirrored[kVvChannel]), dihedral, 1e-9 * dihedral);
    EXPECT_LT(std::abs(s[kHhChannel] - (direct[kHhChannel] - mirrored[kHhChannel])), 1e-9 * dihedral) << elevation;
    EXPECT_LT(std::abs(s[kVvChannel] - (direct[kVvChannel] + mirrored[kVvChannel])), 1e-9 * dihedral) << elevation;
    // Opposite signs, as a dihedral with a horizontal seam has; the difference is the direct lobe of the doubled plate.
    EXPECT_LT(std::abs(s[kHhChannel] + s[kVvChannel]), 2 * std::abs(direct[kHhChannel]) + 1e-9 * dihedral);
  }
}

// The same as a mesh: a large conducting floor under the plate, with the solver's own two bounces. The difference is
// due to the floor's finite size.
TEST(SeaReflection, PlateOnAMeshedFloorHasTheSameEcho) {
  const double width = 0.3, height = 0.2, elevation = 30;
  TriangleMesh plate = make_plate(width, height);
  for (Vec3& x : plate.vertices) x.z() += 0.5 * height;
  const auto s = over_sea(Scatterer(plate), direction(0, elevation), 0, conductor(), k16);
  // As large as the beams need: height / tan(el).
  const double depth = height / std::tan(radians(elevation));
  TriangleMesh corner = plate, floor;
  floor.vertices = {{0, -width / 2, 0}, {depth, -width / 2, 0}, {depth, width / 2, 0}, {0, width / 2, 0}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  floor.triangle_part = {0, 0};
  floor.triangle_material = {0, 0};
  floor.part_names = {"floor"};
  floor.materials = plate.materials;
  corner.append(floor);
  const auto with_floor = echo(Scatterer(corner), radar_basis(direction(0, elevation)), k16, 3.5e-4);
  double worst_db = 0;
  for (const int i : {kHhChannel, kVvChannel}) {
    fmt::print("plate on a floor: {:.3f} dB\n", dbsm(s[i]) - dbsm(with_floor[i]));
    worst_db = std::max(worst_db, std::abs(dbsm(s[i]) - dbsm(with_floor[i])));
    EXPECT_NEAR(dbsm(s[i]) - dbsm(with_floor[i]), 0, 0.5) << i;
    // Side lobes of single bounces, each 1 / (k h sin el) of the echo: 1/33 for either face.
    EXPECT_LT(std::abs(s[i] - with_floor[i]), 0.08 * std::abs(s[i])) << i;
  }
  record_figure(worst_db, 2, "sea_plate_on_floor_db");
}

TEST(SeaReflection, AFloatingBodyIsItsDryPart) {
  // An upright cylinder submerged to its middle: broadside half of it scatters, from above all of its top, from below
  // nothing, and the inside is not visible to the image.
  const TriangleMesh whole = make_cylinder(0.4, 0.6, 90);
  TriangleMesh mesh = whole, top = make_cylinder(0.4, 0.3, 90);
  for (Vec3& x : top.vertices) x.z() += 0.15;
  std::vector<MaterialSpec> materials{MaterialSpec{}};
  cut_at_sea_level(mesh, materials, 0);
  // Flat facets: a cut through them creates vertices off the smooth surface.
  const Scatterer floating(mesh, materials, 0);
  const auto broadside = echo(floating, radar_basis(Vec3::UnitX()), k16, 7e-4),
             half = echo(Scatterer(top, {}, 0), radar_basis(Vec3::UnitX()), k16, 7e-4);
  for (int i = 0; i < 4; ++i) EXPECT_LT(std::abs(broadside[i] - half[i]), 1e-9 * largest(half));
  const auto above = echo(floating, radar_basis(Vec3::UnitZ()), k16, 7e-4),
             full = echo(Scatterer(whole, {}, 0), radar_basis(Vec3::UnitZ()), k16, 7e-4);
  for (int i = 0; i < 4; ++i) EXPECT_LT(std::abs(above[i] - full[i]), 1e-9 * largest(full));
  EXPECT_EQ(largest(echo(floating, radar_basis(-Vec3::UnitZ()), k16, 7e-4)), 0);
}

TEST(SeaReflection, MatrixIsTheSumOfItsDirectAndMultipathParts) {
  const Scatterer reflector(make_icosahedral_reflector());
  SeaReflectionSpec all, direct, multipath;
  direct.paths = SeaPaths::kDirect;
  multipath.paths = SeaPaths::kMultipath;
  const Vec3 r = direction(33, 2);
  const auto a = over_sea(reflector, r, 0.75, SeaReflection(all, 0.3), k16),
             d = over_sea(reflector, r, 0.75, SeaReflection(direct, 0.3), k16),
             m = over_sea(reflector, r, 0.75, SeaReflection(multipath, 0.3), k16);
  EXPECT_EQ(d, echo(reflector, radar_basis(r), k16));
  for (int i = 0; i < 4; ++i) EXPECT_LT(std::abs(a[i] - d[i] - m[i]), 1e-12);
}

// Relative L2 error, dB, of a body's response over the sea against fresh matrices at random pulses and frequencies.
double error_against_independent_traces(const Scatterer& scatterer, const Trajectory& trajectory, const Vec3& r,
                                        const SeaReflection& sea, Polarisation polarisation, int spots) {
  const IntervalSampling sampling = paper_interval(0.3);
  const RadarBasis radar = radar_basis(r), image = radar_basis(image_direction(r));
  const int element = static_cast<int>(polarisation);
  const IntervalResult body =
      interval_response(scatterer, trajectory, r, polarisation, sampling, SolverSpec{}, 2, &sea);
  Random random({8, Stream::kTest, 0});
  RelativeError error;
  for (int spot = 0; spot < spots; ++spot) {
    const int n = static_cast<int>(random.below(256)), b = static_cast<int>(random.below(40));
    const Pose pose = trajectory.pose(sampling.pulse_time_s[n]);
    const Mat3 R_BT = pose.R.transpose();
    const double k = wavenumber(sampling.first_hz + (sampling.pulse_first[n] + b) * sampling.step_hz);
    Complex independent = 0;
    for (const PropagationPath& path : kFourPaths) {
      const auto in_body = [&](const RadarBasis& w) { return RadarBasis{R_BT * w.r, R_BT * w.h, R_BT * w.v}; };
      const RadarBasis &t = path.outbound_via_sea ? image : radar, &s = path.return_via_sea ? image : radar;
      const BistaticGeometry pair =
          path.outbound_via_sea == path.return_via_sea ? monostatic(in_body(t)) : bistatic(in_body(t), in_body(s));
      // The two paths that meet the sea once are reciprocal: mean of each and of the other's transposed matrix.
      const auto matrix_of = [&](const BistaticGeometry& of) {
        return scattering_matrices(scatterer, of, std::array{k}, {0, kDefaultBounces, SolverSpec{}.edges}, 2)[0];
      };
      const auto matrix = reciprocal_mean(matrix_of(pair), matrix_of({pair.receive, pair.transmit, pair.monostatic}));
      independent += SeaReflection::path_factor(path, sea.at(k, r.z()), element) *
                     std::polar(1.0, k * (t.r + s.r).dot(pose.p)) * matrix[element];
    }
    error.add(body.response.at(n, b), independent);
  }
  return error.db();
}

// Sinusoids of attitude and heave with these rates (rad/s, m/s) at a period of 3 s.
Trajectory heaving_and_rocking(const Vec3& angle_rates, double heave_rate, const Vec3& rest) {
  const double omega = 2 * kPi / 3;
  std::vector<MotionSample> samples;
  for (int i = 0; i <= 100; ++i) {
    const double phase = omega * 0.01 * i;
    MotionSample sample;
    sample.angles = angle_rates / omega * std::sin(phase);
    sample.angle_rates = angle_rates * std::cos(phase);
    sample.translation = {0, 0, heave_rate / omega * std::sin(phase)};
    sample.translation_rates = {0, 0, heave_rate * std::cos(phase)};
    samples.push_back(sample);
  }
  return Trajectory(0, 0.01, samples, rest, Vec3::Zero());
}

TEST(SeaReflection, ResponseOverAnIntervalMatchesIndependentTraces) {
  const Scatterer reflector(make_icosahedral_reflector());
  const Trajectory trajectory = heaving_and_rocking({0.3, -0.2, 0.4}, 0.6, {12, 5, 0.75});
  const SeaReflection sea(SeaReflectionSpec{}, 0.1);
  const auto error_db = [&](Polarisation polarisation) {
    return error_against_independent_traces(reflector, trajectory, direction(20, 2), sea, polarisation, 20);
  };
  for (const auto& [polarisation, name] : {std::pair{Polarisation::kVv, "vv"}, {Polarisation::kHh, "hh"}}) {
    const double error = error_db(polarisation);
    fmt::print("reflector over the sea, {}: {:.1f} dB\n", name, error);
    record_figure(error, 1, "sea_reflector_{}_db", name);
    EXPECT_LT(error, -40);
  }
  const double cross_polarised = error_db(Polarisation::kHv);
  fmt::print("reflector over the sea, hv: {:.1f} dB\n", cross_polarised);
  EXPECT_LT(cross_polarised, -40);
}

TEST(SeaReflection, ShipsResponseOverAnIntervalMatchesIndependentTraces) {
  TriangleMesh mesh = read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb");
  std::vector<MaterialSpec> materials(mesh.materials.size());
  cut_at_sea_level(mesh, materials, 0);
  const Scatterer ship(mesh, materials);
  const Trajectory trajectory = heaving_and_rocking({radians(0.8), radians(0.6), radians(0.3)}, 0.5, Vec3::Zero());
  const double error_db = error_against_independent_traces(
      ship, trajectory, direction(50, 2), SeaReflection(SeaReflectionSpec{}, 0.1), Polarisation::kVv, 5);
  fmt::print("ship over the sea: {:.1f} dB\n", error_db);
  record_figure(error_db, 1, "sea_ship_db");
  EXPECT_LT(error_db, -30);
}

TEST(SeaReflection, ResponseDoesNotDependOnThreads) {
  const Scatterer plate(make_plate(0.5, 0.4));
  IntervalSampling sampling;
  sampling.first_hz = 16e9;
  sampling.step_hz = 1e6;
  sampling.count = sampling.frequencies_per_pulse = 16;
  sampling.pulse_first = {0, 0};
  sampling.pulse_time_s = {0, 0.001};
  const SeaReflection sea(SeaReflectionSpec{}, 0.1);
  const Trajectory rest = Trajectory::at_rest({0, 0, 2});
  const auto one = interval_response(plate, rest, direction(5, 2), Polarisation::kVv, sampling, SolverSpec{}, 1, &sea),
             two = interval_response(plate, rest, direction(5, 2), Polarisation::kVv, sampling, SolverSpec{}, 2, &sea);
  EXPECT_EQ(one.response.values, two.response.values);
}

}  // namespace
}  // namespace seaglint

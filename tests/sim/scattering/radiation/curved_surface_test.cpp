// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/surface/smooth_surface.h"
#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/points/phase_integral.h"
#include "sim/scattering/radiation/surface_radiation.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Smooth surfaces from facets: exact series, closed forms, and convergence with the facets' size.

std::vector<std::vector<double>> read_numbers(const std::string& name) {
  std::ifstream file(SEAGLINT_SOURCE_DIR "/tests/reference/rcs/" + name);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == 'k') continue;
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::istringstream cells(line);
    std::vector<double> row;
    for (double x; cells >> x;) row.push_back(x);
    rows.push_back(row);
  }
  EXPECT_FALSE(rows.empty()) << name;
  return rows;
}

struct Deviation {
  double mean_db = 0, largest_db = 0, largest_deg = 0;
};

// Errors relative to the exact values, complex amplitudes at the same wavenumbers.
Deviation deviation(const std::vector<Complex>& ours, const std::vector<Complex>& exact) {
  Deviation d;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const double db = std::abs(dbsm(ours[i]) - dbsm(exact[i]));
    d.mean_db += db / static_cast<double>(ours.size());
    d.largest_db = std::max(d.largest_db, db);
    d.largest_deg = std::max(d.largest_deg, std::abs(degrees(std::arg(ours[i] / exact[i]))));
  }
  return d;
}

// At every `step`-th of the series' ka, 60 to 200 by 1.
Deviation sphere_against_mie(int subdivisions, std::optional<double> crease, const Vec3& r_hat, int step) {
  std::vector<double> k;
  std::vector<Complex> mie, ours;
  for (const auto& row : read_numbers("mie_sphere_ka60_200.csv")) {
    if (static_cast<int>(row[0]) % step != 0) continue;
    k.push_back(row[0]);
    mie.emplace_back(row[1], row[2]);
  }
  const Scatterer sphere(make_sphere(1, subdivisions), {}, crease);
  for (const auto& s : scattering_matrices(sphere, monostatic(radar_basis(r_hat)), k, {0, 1}))
    ours.push_back(s[kVvChannel]);
  return deviation(ours, mie);
}

// The residual at 20,480 facets: contour terms next to the specular point (1 / kContourRatio of the ring's
// contribution), quadratic facets (edge^3), the creeping wave (0.017 dB at ka 64).
TEST(CurvedSurface, SphereFollowsTheMieSeriesFromKa60To200) {
  double sum = 0;
  for (const Vec3& r_hat : {direction(23, 11), direction(80, -35), direction(200, 60)}) {
    const Deviation d = sphere_against_mie(5, std::nullopt, r_hat, 3);
    std::printf("20,480 facets: mean %.3f, largest %.3f dB, %.2f deg\n", d.mean_db, d.largest_db, d.largest_deg);
    EXPECT_LT(d.mean_db, 0.05);
    EXPECT_LT(d.largest_db, 0.1);
    EXPECT_LT(d.largest_deg, 1);
    sum += d.mean_db / 3;
  }
  RecordProperty("mean_db", std::to_string(sum));
}

TEST(CurvedSurface, SphereNeedsFewFacets) {
  for (const int subdivisions : {3, 4, 5}) {
    const Deviation flat = sphere_against_mie(subdivisions, 0.0, direction(23, 11), 3);
    const Deviation smooth = sphere_against_mie(subdivisions, std::nullopt, direction(23, 11), 3);
    std::printf("%d facets: flat mean %.3f, largest %.3f dB, %.1f deg; smooth mean %.3f, largest %.3f dB, %.2f deg\n",
                20 << (2 * subdivisions), flat.mean_db, flat.largest_db, flat.largest_deg, smooth.mean_db,
                smooth.largest_db, smooth.largest_deg);
    const int facets = 20 << (2 * subdivisions);
    record_figure(smooth.mean_db, 3, "sphere_{}_mean_db", facets);
    record_figure(smooth.largest_db, 3, "sphere_{}_largest_db", facets);
    record_figure(smooth.largest_deg, 2, "sphere_{}_largest_deg", facets);
    record_figure(flat.mean_db, 3, "sphere_{}_flat_mean_db", facets);
    record_figure(flat.largest_db, 2, "sphere_{}_flat_largest_db", facets);
    record_figure(flat.largest_deg, 1, "sphere_{}_flat_largest_deg", facets);
    EXPECT_LT(smooth.mean_db, 0.05);
    EXPECT_LT(smooth.largest_db, 0.1);
    EXPECT_LT(smooth.largest_deg, 1);
  }
}

// sigma_3D = sigma_2D 2 L^2 / lambda: S = j L F / pi, with H_z of the incident and the scattered wave of opposite sign
// for h.
TEST(CurvedSurface, CylinderAtBroadsideFollowsTheExactSeries) {
  const double radius = 0.5, height = 1.2;
  std::vector<double> k;
  std::vector<Complex> tm, te;
  for (const auto& row : read_numbers("cylinder_ka60_200.csv")) {
    k.push_back(row[0] / radius);
    tm.push_back(Complex(0, height / kPi) * Complex(row[1], row[2]));
    te.push_back(Complex(0, -height / kPi) * Complex(row[3], row[4]));
  }
  Deviation worst;
  for (const int segments : {36, 72, 144, 720}) {
    for (const bool flat : {true, false}) {
      const Scatterer cylinder(make_cylinder(radius, height, segments), {}, flat ? std::optional(0.0) : std::nullopt);
      std::vector<Complex> h, v;
      for (const auto& s : scattering_matrices(cylinder, monostatic(radar_basis(direction(17, 0))), k, {0, 1})) {
        h.push_back(s[kHhChannel]);
        v.push_back(s[kVvChannel]);
      }
      const Deviation dv = deviation(v, tm), dh = deviation(h, te);
      std::printf("%d sides, %s: vv mean %.3f, largest %.3f dB, %.2f deg; hh %.3f, %.3f dB, %.2f deg\n", segments,
                  flat ? "flat" : "smooth", dv.mean_db, dv.largest_db, dv.largest_deg, dh.mean_db, dh.largest_db,
                  dh.largest_deg);
      if (flat) {
        record_figure(std::max(dv.mean_db, dh.mean_db), 3, "cylinder_{}_flat_mean_db", segments);
        continue;
      }
      worst.mean_db = std::max({worst.mean_db, dv.mean_db, dh.mean_db});
      worst.largest_db = std::max({worst.largest_db, dv.largest_db, dh.largest_db});
      worst.largest_deg = std::max({worst.largest_deg, dv.largest_deg, dh.largest_deg});
      // Physical optics has a phase error of 5/16 and 11/16 of 1/ka: 0.3 and 0.7 deg at ka 60; the contour next to the
      // flash 1 / (kContourRatio^1.5).
      EXPECT_LT(dv.mean_db, 0.05) << segments;
      EXPECT_LT(dv.largest_db, 0.1) << segments;
      EXPECT_LT(dh.largest_db, 0.1) << segments;
      EXPECT_LT(dv.largest_deg, 1.5) << segments;
      EXPECT_LT(dh.largest_deg, 1.5) << segments;
    }
  }
  record_figure(worst.mean_db, 3, "cylinder_mean_db");
  record_figure(worst.largest_db, 3, "cylinder_largest_db");
  record_figure(worst.largest_deg, 2, "cylinder_largest_deg");
}

// Bistatic sphere of the Austin suite (problem set IA), D = 19.2 m, 0.32 GHz, incidence from phi 0, in the plane theta
// = 90.
TEST(CurvedSurface, BistaticSphereFollowsTheSeriesOverTheIlluminatedHalf) {
  const Scatterer sphere(make_sphere(9.6, 5));
  const RadarBasis transmit = radar_basis(direction(0, 0));
  std::array<double, 4> worst_mean{}, worst{};  // of both polarisations
  for (const auto& [file, channel] :
       {std::pair{"austin/ref_rcs.I.A.s7.f6.H.txt", kHhChannel}, {"austin/ref_rcs.I.A.s7.f6.V.txt", kVvChannel}}) {
    std::array<double, 4> sum{}, largest{};
    std::array<int, 4> count{};
    for (const auto& row : read_numbers(file)) {
      const double phi = row[2];
      if (std::fmod(phi, 5) != 0 || phi >= 120) continue;
      const auto s = scattering_matrices(sphere, bistatic(transmit, radar_basis(direction(phi, 0))),
                                         std::array{wavenumber(0.32e9)}, {0, 1})[0];
      const double difference = std::abs(dbsm(s[channel]) - row[3]);
      const auto sector = static_cast<std::size_t>(phi / 30);
      sum[sector] += difference;
      largest[sector] = std::max(largest[sector], difference);
      ++count[sector];
    }
    for (int i = 0; i < 4; ++i) {
      std::printf("%s phi %d-%d: mean %.3f, largest %.3f dB\n", file, 30 * i, 30 * i + 30, sum[i] / count[i],
                  largest[i]);
      worst_mean[i] = std::max(worst_mean[i], sum[i] / count[i]);
      worst[i] = std::max(worst[i], largest[i]);
    }
    // The incident shadow boundary is 90 deg from backscatter, that of the receiver moves inwards with phi.
    EXPECT_LT((sum[0] + sum[1] + sum[2]) / (count[0] + count[1] + count[2]), 0.5) << file;
  }
  for (int i = 0; i < 4; ++i) {
    record_figure(worst_mean[i], 2, "bistatic_sphere_{}_deg_mean_db", 30 * i + 30);
    record_figure(worst[i], 2, "bistatic_sphere_{}_deg_largest_db", 30 * i + 30);
  }
}

// The specular point of a sphere may be anywhere in a facet; the edges of facets must have no effect.
TEST(CurvedSurface, EdgesOfFacetsDoNotRadiate) {
  const double ka = 150;
  const Scatterer smooth(make_sphere(1, 4)), flat(make_sphere(1, 4), {}, 0);
  const auto ripple = [&](const Scatterer& sphere) {
    double lowest = 1e9, highest = -1e9;
    for (int i = 0; i < 40; ++i) {
      const double level =
          dbsm(echo(sphere, radar_basis(direction(20 + 0.25 * i, 10 + 0.1 * i)), ka, 0, 1)[kVvChannel]);
      lowest = std::min(lowest, level);
      highest = std::max(highest, level);
    }
    return highest - lowest;
  };
  const double with_edges = ripple(flat), without = ripple(smooth);
  std::printf("5,120 facets, ka 150, ripple over 10 deg: flat %.3f dB, smooth %.3f dB\n", with_edges, without);
  record_figure(without, 2, "sphere_ripple_db");
  record_figure(with_edges, 2, "sphere_ripple_flat_db");
  EXPECT_LT(without, 0.2);
  EXPECT_LT(without, 0.25 * with_edges);
}

// A sharp shadow edge of a sphere adds a spurious end point, -jk integral of z e^{2jkz} dz at z = 0: +j/(4k). Its phase
// is constant while the specular one varies with 2ka, so that a mean over whole cycles isolates it.
TEST(CurvedSurface, TheShadowBoundaryDoesNotRadiate) {
  constexpr int kSteps = 60;
  std::vector<double> ka;
  for (int i = 0; i < kSteps; ++i) ka.push_back(60 + 3 * kPi * i / kSteps);  // three cycles of 2 ka
  const auto false_end = [&](const Scatterer& sphere) {
    const auto s = scattering_matrices(sphere, monostatic(radar_basis(direction(23, 11))), ka, {0, 1});
    Complex mean = 0;
    for (int i = 0; i < kSteps; ++i) {
      // Physical optics of the specular point, to 1/(ka).
      const Complex specular = -0.5 * std::polar(1.0, 2 * ka[i]) * Complex(1, 1 / (2 * ka[i]));
      mean += (s[i][kVvChannel] - specular) * 4.0 * ka[i] / Complex(0, kSteps);
    }
    return std::abs(mean);
  };
  const double hard = false_end(Scatterer(make_sphere(1, 5), {}, 0)), faded = false_end(Scatterer(make_sphere(1, 5)));
  std::printf("false end point of the shadow boundary: hard %.2f, faded %.3f of j/(4k)\n", hard, faded);
  record_figure(faded, 3, "shadow_end_point");
  record_figure(hard, 2, "shadow_end_point_flat");
  EXPECT_GT(hard, 0.5);
  EXPECT_LT(faded, 0.1);
}

// A cylinder on a plate reflects a wave that is incident on either of them first and on the other next. Unfolded in the
// plate, either path is the cylinder's specular flash at its full height: together |S| = (k / pi) L cos(el) R sqrt(pi /
// (k R cos(el))), whatever the distance between them.
TEST(CurvedSurface, CylinderOnAPlateHasTheTopHatsEcho) {
  const double radius = 0.5, height = 0.4, k = wavenumber(8e9), elevation = radians(40);
  const double expected =
      k / kPi * height * std::cos(elevation) * radius * std::sqrt(kPi / (k * radius * std::cos(elevation)));
  double worst = 0, worst_mean = 0, worst_flat_mean = 0;
  for (const int segments : {72, 144, 288}) {
    TriangleMesh hat =
        transformed(make_cylinder(radius, height, segments), Mat3::Identity(), {0, 0, 0.5 * height + 1e-4});
    TriangleMesh floor = transformed(make_plate(4, 4), axis_rotation(-kPi / 2, Vec3::UnitY()), Vec3::Zero());
    hat.append(floor);
    std::array<double, 2> mean{};
    for (int mode = 0; mode < 2; ++mode) {
      const Scatterer scatterer(hat, {}, mode == 0 ? std::optional(0.0) : std::nullopt);
      constexpr int kViews = 12;
      double largest = 0;
      for (int i = 0; i < kViews; ++i) {
        const RadarBasis basis = radar_basis(direction(3 + 0.37 * i, degrees(elevation)));
        const auto both = echo(scatterer, basis, k, 0, 2), once = echo(scatterer, basis, k, 0, 1);
        const double db = 20 * std::log10(std::abs(both[kVvChannel] - once[kVvChannel]) / expected);
        mean[mode] += db / kViews;
        largest = std::max(largest, std::abs(db));
      }
      std::printf("top hat, %d sides, %s: mean %.2f, largest %.2f dB\n", segments, mode == 0 ? "flat" : "smooth",
                  mean[mode], largest);
      if (mode == 1) {
        worst = std::max(worst, largest);
        EXPECT_LT(largest, 0.5) << segments;
      }
    }
    worst_flat_mean = std::max(worst_flat_mean, std::abs(mean[0]));
    worst_mean = std::max(worst_mean, std::abs(mean[1]));
  }
  record_figure(worst, 2, "top_hat_largest_db");
  record_figure(worst_mean, 2, "top_hat_mean_db");
  record_figure(worst_flat_mean, 2, "top_hat_flat_mean_db");
}

TEST(SmoothSurface, KeepsSharpTargetsFlat) {
  EXPECT_EQ(Scatterer(make_icosahedral_reflector()).surface().curved_count(), 0u);
  EXPECT_EQ(Scatterer(make_plate(0.3, 0.2)).surface().curved_count(), 0u);
  EXPECT_EQ(Scatterer(make_square_trihedral(1)).surface().curved_count(), 0u);
  EXPECT_EQ(Scatterer(make_cylinder(0.5, 1, 12)).surface().curved_count(), 0u)
      << "sides whose normals differ by 30 deg are edges";
  EXPECT_EQ(Scatterer(make_cylinder(0.5, 1, 24)).surface().curved_count(), 48u) << "caps stay flat";
}

TEST(SmoothSurface, HasTheCurvatureAndSagittaOfASphere) {
  const double radius = 2;
  const Scatterer sphere(make_sphere(radius, 4));
  for (int f = 0; f < 5120; f += 97) {
    const CurvedFacet& curved = *sphere.surface().curved(f);
    for (int i = 0; i < 3; ++i) {
      const SmoothVertex& vertex = sphere.surface().vertex(curved.vertex[i]);
      const Vec3& x = sphere.facets()[f].corner[i];
      EXPECT_LT((vertex.normal - x.normalized()).norm(), 2e-3);
      const double edge = (sphere.facets()[f].corner[(i + 1) % 3] - x).norm();
      EXPECT_NEAR(curved.sagitta[i], edge * edge / (8 * radius), 0.06 * edge * edge / (8 * radius));
      const Vec3 t = vertex.normal.unitOrthogonal();
      EXPECT_NEAR(t.dot(vertex.curvature * t), 1 / radius, 0.1 / radius);
    }
  }
}

// A box 1 m wide whose edges are rounded by strips of 5 deg and 9 mm: its faces may be curved by no more than the
// strips are.
TEST(SmoothSurface, KeepsALargeFaceFlatNextToAFillet) {
  const double radius = 0.1, half = 0.5;
  TriangleMesh mesh;
  const auto column = [&](double y, double x) {
    mesh.vertices.push_back({x, y, 0});
    mesh.vertices.push_back({x, y, 1});
  };
  column(-half, 0);
  for (int i = 0; i <= 9; ++i)
    column(half + radius * std::sin(radians(10.0 * i)), -radius * (1 - std::cos(radians(10.0 * i))));
  for (std::uint32_t i = 0; i + 3 < mesh.vertices.size(); i += 2) {
    mesh.triangles.push_back({i, i + 2, i + 3});
    mesh.triangles.push_back({i, i + 3, i + 1});
  }
  const Scatterer scatterer(mesh);
  double strip = 0;
  for (const double s : scatterer.surface().curved(6)->sagitta) strip = std::max(strip, std::abs(s));
  for (int f = 0; f < 2; ++f) {
    const CurvedFacet* face = scatterer.surface().curved(f);
    for (int i = 0; face && i < 3; ++i) EXPECT_LE(std::abs(face->sagitta[i]), 1.1 * strip);
  }
}

// A flat strip seen at up to 1e-6 rad, whose end points may not replace it over the aspect change: cut across its
// length on the panel, not across its image.
TEST(Points, OfAStripAreAsManyAsItIsLong) {
  constexpr double kLength = 0.5, kWidth = 0.004, k = 63;
  const RadarBasis basis = radar_basis(Vec3::UnitX());
  for (const double steepness : {1.0, 1e2, 1e6}) {
    Footprint strip;
    const double length = kLength / std::hypot(1, steepness);
    strip.plane.slope = Vec2(steepness, 0);
    strip.psi_slope = strip.psi_slope_rate = 1.5;
    strip.panel_size = kLength;
    strip.w = Vec2(1.5 * kLength / length, 0);
    for (const Vec2& p : {Vec2(0, 0), Vec2(length, 0), Vec2(length, kWidth), Vec2(0, kWidth)})
      strip.polygon.push_back({p, Vec2::Zero(), Vec2::Zero()});
    std::vector<Point> pieces;
    decompose({{}, {}, strip}, {monostatic(basis)}, {FrequencyBand(k), 0, 0.05}, pieces);
    EXPECT_GE(pieces.size(), k * 1.5 * kLength) << steepness;
    EXPECT_LE(pieces.size(), 2 * k * 1.5 * kLength) << steepness;
  }
}

// A strip behind a curved reflector, on a flat panel seen at up to 1e-6 rad, inside a beam that is longer than the
// panel by as much: a radian of phase per piece over its length, less than twice as many by halving, one more at either
// end, and at most two across; their sum is the closed form.
TEST(CurvedSurface, PiecesOfAStripAreAsManyAsItIsLong) {
  constexpr double kLength = 0.5, kWidth = 0.004, kSlope = 1.5, kAcross = 0.3, k = 63;
  for (const double steepness : {0.0, 1e2, 1e6}) {
    Footprint strip;
    const double area_ratio = std::hypot(1, steepness), length = kLength / area_ratio;
    strip.plane.slope = Vec2(steepness, 0);
    strip.w = Vec2(kSlope * area_ratio, kAcross);
    for (const Vec2& p : {Vec2(0, 0), Vec2(length, 0), Vec2(length, kWidth), Vec2(0, kWidth)})
      strip.polygon.push_back({p, Vec2::Zero(), Vec2::Zero()});
    const std::array corner{Vec2(-0.11, -0.013), Vec2(0.77, -0.013), Vec2(-0.11, 0.031)};
    CurvedFootprint beam{corner, Barycentric(corner), {}, {}, {}, {}, {}, true, true, {}, {}, {}};
    beam.incident_shadow_distance.fill(1e9);
    beam.receiver_shadow_distance.fill(1e9);
    strip.curvature = std::make_shared<const CurvedFootprint>(beam);
    const std::vector<CurvedTerm> pieces = curved_terms(strip, FrequencyBand(k), 2 * kSlope);
    EXPECT_LE(pieces.size(), 2 * (2 * k * kSlope * kLength + 2)) << steepness;
    Complex sum = 0;
    for (const CurvedTerm& piece : pieces) sum += piece.integral[0] * std::polar(1.0, k * piece.psi);
    const double along = k * kSlope * kLength / 2, across = k * kAcross * kWidth / 2;
    const Complex exact =
        length * kWidth * std::sin(along) / along * std::sin(across) / across * std::polar(1.0, along + across);
    EXPECT_LT(std::abs(sum - exact), 1e-7 * length * kWidth) << steepness;
    std::printf("steepness %g: %zu pieces, error %.1e of the area\n", steepness, pieces.size(),
                std::abs(sum - exact) / (length * kWidth));
  }
}

// A cut of a facet by the solver is fixed to the body: one trace is valid over an aspect change, however far along the
// line of sight the body is from its origin.
TEST(CurvedSurface, IsValidOverAnAspectChangeAtAnyPosition) {
  const double k = wavenumber(10e9);
  for (const Vec3& place : {Vec3(0, 0, 0), Vec3(20, 0, 0), Vec3(0, 0, 20)}) {
    const Scatterer sphere(transformed(make_sphere(1, 4), Mat3::Identity(), place));
    const Vec3 r = direction(0, 0);
    TracingSettings settings;
    const auto points = points_of(sphere, monostatic(radar_basis(r)), k, radians(0.075), settings).points;
    for (const double aspect_change_deg : {0.02, 0.05, 0.07}) {
      const Vec3 there = direction(aspect_change_deg, 0);
      const Complex independent = echo(sphere, radar_basis(there), k)[kVvChannel];
      const Complex from_points = direct_sum(points, k, there - r)[kVvChannel];
      // Half the aspect change squared times the distance, k 20 (1.2e-3)^2 = 0.006 rad; frozen amplitudes 0.2 %.
      EXPECT_LT(std::abs(from_points - independent), 0.01 * std::abs(independent))
          << place.x() << ' ' << place.y() << ' ' << place.z() << ", aspect change " << aspect_change_deg;
    }
  }
}

// A cylinder on a plate of two triangles: the double bounce of a top hat against its closed form.

constexpr double kCell = 0.03;  // m, of the wall's facets

std::uint32_t add_vertex(TriangleMesh& mesh, double x, double y, double z) {
  mesh.vertices.push_back({x, y, z});
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

// The part of a cylinder's wall within 1.3 rad of the x axis, of quads about kCell wide, upright on the plate z = 0,
// which reaches as far beyond it as a wave from `elevation_deg` needs to illuminate the whole wall. The plate's two
// triangles start at its corner number `cut`, 0..3.
TriangleMesh top_hat(double radius, double height, double elevation_deg, std::size_t cut = 0) {
  TriangleMesh mesh = make_plate(1, 1);
  mesh.vertices.clear();
  mesh.triangles.clear();
  constexpr double kHalf = 1.3;
  const int columns = static_cast<int>(std::ceil(2 * kHalf * radius / kCell)),
            rows = static_cast<int>(std::ceil(height / kCell));
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double angle = kHalf * (2.0 * i / columns - 1);
      add_vertex(mesh, radius * std::cos(angle), radius * std::sin(angle), height * j / rows);
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (columns + 1) + i), c = a + static_cast<std::uint32_t>(columns) + 1;
      mesh.triangles.push_back({a, a + 1, c + 1});
      mesh.triangles.push_back({a, c + 1, c});
    }
  }
  const double reach = radius + 1.5 * height / std::tan(radians(elevation_deg));
  const std::array<std::uint32_t, 4> corner{add_vertex(mesh, 0, -reach, 0), add_vertex(mesh, reach, -reach, 0),
                                            add_vertex(mesh, reach, reach, 0), add_vertex(mesh, 0, reach, 0)};
  const auto at = [&](std::size_t i) { return corner[(cut + i) % 4]; };
  mesh.triangles.push_back({at(0), at(2), at(3)});  // with cut 0 the wall reflects to the other triangle of the panel
  mesh.triangles.push_back({at(0), at(1), at(2)});
  mesh.triangle_part.assign(mesh.triangles.size(), 0);
  mesh.triangle_material.assign(mesh.triangles.size(), 0);
  return mesh;
}

// Two bounces, plate and wall in either order. By image theory in the plate, stationary phase about the azimuth of the
// radar gives each the amplitude of a cylinder of radius R cos(el) and height h at normal incidence, h sqrt(k R cos(el)
// / 4 pi) (sigma = k a h^2 of a cylinder of radius a); both orders have the same path and add in phase.
double closed_form(double k, double radius, double height, double elevation_deg) {
  return 2 * height * std::sqrt(k * radius * std::cos(radians(elevation_deg)) / (4 * kPi));
}

struct TopHat {
  double radius, height, elevation_deg;
};

class TopHatEcho : public testing::TestWithParam<TopHat> {};

// Terms of the bound: stationary phase, 1 / (8 k R cos(el)) of the amplitude, 0.05 dB at most here; the facets' second
// order, edge^3, 0.1 dB.
TEST_P(TopHatEcho, HasTheClosedFormInEveryView) {
  const auto& [radius, height, elevation_deg] = GetParam();
  const Scatterer scatterer(top_hat(radius, height, elevation_deg));
  const double k = wavenumber(8e9), expected = dbsm(closed_form(k, radius, height, elevation_deg));
  TracingSettings settings{0, 2};
  settings.filter.included.push_back({ContributionSelector::Kind::kBounces, 2});
  double min = 1e9, max = -1e9;
  for (int i = 0; i <= 7; ++i) {
    const Vec3 r_hat = direction(-1.5 + 0.67 * i, elevation_deg);
    const auto s = scattering_matrices(scatterer, monostatic(radar_basis(r_hat)), std::array{k}, settings)[0];
    for (const Channel channel : {kHhChannel, kVvChannel}) {
      min = std::min(min, dbsm(s[channel]));
      max = std::max(max, dbsm(s[channel]));
    }
  }
  std::printf("R %.1f m, h %.1f m, elevation %.0f deg: %.2f to %.2f dBsm, closed form %.2f\n", radius, height,
              elevation_deg, min, max, expected);
  record_figure(std::max(max - expected, expected - min), 2, "top_hat_{:.0f}cm_{:.0f}cm_{:.0f}deg_db", 100 * radius,
                100 * height, elevation_deg);
  constexpr double bound_db = 0.15;
  EXPECT_GT(min, expected - bound_db);
  EXPECT_LT(max, expected + bound_db);
}

INSTANTIATE_TEST_SUITE_P(RadiiHeightsAndElevations, TopHatEcho,
                         testing::Values(TopHat{0.5, 0.4, 40}, TopHat{1, 0.4, 40}, TopHat{1, 0.6, 40},
                                         TopHat{1, 0.4, 25}, TopHat{0.3, 0.4, 40}, TopHat{0.5, 0.8, 40},
                                         TopHat{0.5, 0.4, 25}));

// An odd number of columns has a facet that faces the x axis, so that the phase is stationary inside its footprint.
// Bound: the choice between contour and area depends on the triangle, and the two differ by kContourRatio^-1.5.
TEST(TopHat, IsIndependentOfTriangulation) {
  constexpr double kRadius = 0.49, kHeight = 0.4, kElevationDeg = 40;
  const double k = wavenumber(8e9);
  TracingSettings settings{0, 2};
  settings.filter.included.push_back({ContributionSelector::Kind::kBounces, 2});
  std::vector<Scatterer> hats;
  hats.reserve(4);
  for (std::size_t cut = 0; cut < 4; ++cut) hats.emplace_back(top_hat(kRadius, kHeight, kElevationDeg, cut));
  double max = 0;
  for (int i = 0; i <= 12; ++i) {
    const auto antennas = monostatic(radar_basis(direction(-1.5 + 0.4 * i, kElevationDeg)));
    const auto echo_of = [&](const Scatterer& hat) {
      return scattering_matrices(hat, antennas, std::array{k}, settings)[0][kVvChannel];
    };
    const Complex first = echo_of(hats[0]);
    for (std::size_t cut = 1; cut < 4; ++cut)
      max = std::max(max, std::abs(echo_of(hats[cut]) - first) / closed_form(k, kRadius, kHeight, kElevationDeg));
  }
  std::printf("four triangulations of the plate: echoes differ by %.5f of the closed form at most\n", max);
  record_figure(max, 5, "top_hat_cut");
  EXPECT_LT(max, std::pow(kContourRatio, -1.5));
}

// An upright cylinder before a level rectangle whose border cuts the rays that the cylinder spreads, against
// geometrical and physical optics of the exact cylinder (tests/reference/rcs/cylinder_patch.py).

// Cylinder of so many strips, and a rectangle in z = 0 from (x0, y0) to (x1, y1).
TriangleMesh cylinder_before(const std::array<Vec2, 2>& rectangle, int strips) {
  TriangleMesh body = transformed(make_cylinder(0.5, 1, strips), Mat3::Identity(), {0, 0, 0.5});
  const Vec2 size = rectangle[1] - rectangle[0], centre = 0.5 * (rectangle[0] + rectangle[1]);
  const Mat3 level = axis_rotation(-kPi / 2, Vec3::UnitY());
  body.append(transformed(make_plate(size.y(), size.x()), level, {centre.x(), centre.y(), 0}));
  return body;
}

// Relative error of hh and vv over all views and frequencies. Causes: the parts of beams that are limited next to the
// border, which six halvings leave (rays_are_limited() of the beam tracer), and rays that a flat projection of a wide
// strip does not lead to the rectangle. They fall with the width of the strips.
TEST(CylinderBeforeAPatch, IsThatOfGeometricalAndPhysicalOptics) {
  const std::map<int, std::array<Vec2, 2>> rectangles{{1, {Vec2(0.8, -0.3), Vec2(1.15, 0.25)}},
                                                      {2, {Vec2(0.8, -0.05), Vec2(1.15, 0.05)}}};
  const std::map<std::pair<int, int>, double> reached{{{1, 24}, 0.21},  {{1, 48}, 0.11}, {{1, 96}, 0.035},
                                                      {{1, 768}, 0.02}, {{2, 24}, 0.51}, {{2, 48}, 0.34},
                                                      {{2, 96}, 0.13},  {{2, 768}, 0.03}};
  for (const auto& [place, bound] : reached) {
    const auto& [number, strips] = place;
    const Scatterer body(cylinder_before(rectangles.at(number), strips));
    double error = 0, power = 0;
    for (const auto& row : read_csv("cylinder_patch.csv")) {
      if (std::stoi(row[0]) != number) continue;
      const double k = wavenumber(std::stod(row[3]) * 1e9);
      const auto view = monostatic(radar_basis(direction(std::stod(row[1]), std::stod(row[2]))));
      const auto S = scattering_matrices(body, view, {&k, 1}, {})[0];
      const Complex hh(std::stod(row[4]), std::stod(row[5])), vv(std::stod(row[6]), std::stod(row[7]));
      error += std::norm(S[kHhChannel] - hh) + std::norm(S[kVvChannel] - vv);
      power += std::norm(hh) + std::norm(vv);
    }
    const double relative = std::sqrt(error / power);
    std::printf("rectangle %d, cylinder of %d strips: error %.3f of the echo\n", number, strips, relative);
    EXPECT_LT(relative, bound) << number << ' ' << strips;
    EXPECT_GT(power, 0);
  }
}

}  // namespace
}  // namespace seaglint

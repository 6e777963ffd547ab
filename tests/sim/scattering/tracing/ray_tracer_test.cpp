// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/sums/sweep_sum.h"
#include "sim/scattering/tracing/ray_paths.h"
#include "sim/scattering/tracing/transmitted_wave.h"
#include "tests/refusal.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

TEST(RayLattice, HasOneRayInEveryCellAndTheQuarterThatContainsItsRay) {
  const Scatterer plate(make_plate(3, 2));
  const RayLattice lattice(plate, radar_basis(direction(20, 5)), 0.004);
  const double side = 0.004 * (1 << RayLattice::kHalvings);
  for (std::size_t tile = 0; tile < lattice.tiles(); ++tile) {
    const Box square = lattice.window(tile).boxes()[0];
    EXPECT_NEAR((square.upper - square.lower).x(), RayLattice::kTileSide * side, 1e-12);
    for (const std::int64_t i : {0, 5, 63}) {
      const LatticeCell cell = lattice.cell(tile, i, 7);
      const Vec2 corner = square.lower + side * Vec2(static_cast<double>(i), 7), ray = lattice.ray(cell);
      const Vec2 inside = ray - corner;
      EXPECT_TRUE(std::min(inside.x(), inside.y()) >= -1e-12 && inside.maxCoeff() <= side + 1e-12);
      const LatticeCell quarter = lattice.quarter(cell, ray);
      EXPECT_EQ(quarter.level, 1);
      EXPECT_EQ(quarter.column, 2 * cell.column + (ray.x() - corner.x() >= side / 2));
      EXPECT_EQ(quarter.row, 2 * cell.row + (ray.y() - corner.y() >= side / 2));
    }
  }
}

TEST(RayLattice, CoversThePlateAndAimsAtEveryPanelThatFacesTheAntenna) {
  TriangleMesh mesh = make_plate(1, 1);
  mesh.append(transformed(make_plate(0.01, 0.01), Mat3::Identity(), {0.5, 0.3, 0.2}));
  const Scatterer target(mesh);
  const RadarBasis basis = radar_basis(direction(10, 0));
  const RayLattice lattice(target, basis, 0.01);
  double area = 0;
  std::size_t aimed = 0;
  for (std::size_t tile = 0; tile < lattice.tiles(); ++tile) {
    area += lattice.window(tile).area();
    aimed += lattice.aimed(tile).size();
    for (const Vec2& ray : lattice.aimed(tile)) {
      const Box square = lattice.window(tile).boxes()[0];
      EXPECT_TRUE(ray.x() >= square.lower.x() && ray.y() >= square.lower.y());
      EXPECT_TRUE(ray.x() < square.upper.x() && ray.y() < square.upper.y());
    }
  }
  EXPECT_GE(area, std::cos(radians(10)));
  EXPECT_GE(aimed, 10u);  // the middle and each of the four sides of both plates
}

TEST(RayLattice, RefusesMoreThanTenThousandMillionRays) {
  const Scatterer plate(make_plate(100, 100));
  EXPECT_NO_THROW(RayLattice(plate, radar_basis(Vec3::UnitX()), 1.01e-3));
  EXPECT_HAS(refusal_of([&] { const RayLattice too_fine(plate, radar_basis(Vec3::UnitX()), 0.9e-3); }),
             "rays 0.0009 m apart over a target of 100 x 100 m are 1.2e+10, more than 1e+10");
}

// Scene of one antenna for rays.
struct Scene {
  Scatterer target;
  RadarBasis basis;
  TracingSettings settings{0, 8, false, {}, SolverMethod::kRays};
  Aspect aspect{target, basis, settings, 1};
  std::vector<Receiver> receivers{{monostatic(basis), aspect.visible}};
  TracingContext context{target, basis, receivers, settings, aspect.visible, {}, SmallestAreas(target, settings)};

  Scene(const TriangleMesh& mesh, const Vec3& r_hat) : target(mesh), basis(radar_basis(r_hat)) {}
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
};

// Random points of the projection plane within `radius` of the origin of the target.
std::vector<Vec2> points(const Scene& scene, int count, double radius) {
  Random random({1, Stream::kTest, 0});
  const Vec3 origin = -scene.target.centre();
  const Vec2 middle(origin.dot(scene.basis.h), origin.dot(scene.basis.v));
  std::vector<Vec2> p;
  for (int i = 0; i < count; ++i)
    p.push_back(middle + radius * Vec2(2 * random.uniform() - 1, 2 * random.uniform() - 1));
  return p;
}

// The sequences that random rays meet.
struct TracedScene : Scene {
  RayPaths paths{context};
  std::vector<Vec2> rays;
  std::vector<std::uint64_t> signatures;

  TracedScene(const TriangleMesh& mesh, const Vec3& r_hat, double radius)
      : Scene(mesh, r_hat), rays(points(*this, 3000, radius)), signatures(rays.size()) {
    paths.start();
    paths.trace(rays, signatures);
  }
};

TEST(RayPaths, ATrihedralReturnsEveryRayOfThreeBouncesAntiparallelFromTheMirroredPoint) {
  const TracedScene scene(make_square_trihedral(1), direction(40, 30), 0.4);
  const RayPaths& paths = scene.paths;
  int triple = 0;
  for (int first = paths.path(0).first_child; first >= 0; first = paths.path(first).next_sibling) {
    for (int second = paths.path(first).first_child; second >= 0; second = paths.path(second).next_sibling) {
      for (int third = paths.path(second).first_child; third >= 0; third = paths.path(third).next_sibling) {
        ++triple;
        EXPECT_LT((paths.path(third).direction - scene.basis.r).norm(), 1e-12);
        // Three mirrors at right angles are an inversion in their corner, the origin of the mesh.
        EXPECT_LT((paths.path(third).image_transform.L + Mat3::Identity()).norm(), 1e-12);
        EXPECT_LT((paths.path(third).image_transform.t + 2 * scene.target.centre()).norm(), 1e-12);
      }
    }
  }
  EXPECT_EQ(triple, 6);  // orders of the three faces
}

TEST(RayPaths, ASignatureDependsNeitherOnTheBatchNorOnTheOrderOfItsRays) {
  TracedScene scene(stepped_corner(), direction(35, 25), 0.3);
  std::vector<std::uint64_t> again(scene.rays.size());
  const std::vector<Vec2> reversed(scene.rays.rbegin(), scene.rays.rend());
  scene.paths.trace(reversed, again);
  std::reverse(again.begin(), again.end());
  EXPECT_EQ(scene.signatures, again);
  const std::set<std::uint64_t> distinct(again.begin(), again.end());
  EXPECT_GT(distinct.size(), 8u);
  EXPECT_LT(distinct.size(), 60u);
}

TEST(RayPaths, ThePlateBeforeACornerIsAnObstacleOfTheWallsThatItHides) {
  const TriangleMesh mesh = stepped_corner();
  TracedScene scene(mesh, direction(35, 25), 0.3);
  scene.paths.finish();
  const RayPaths& paths = scene.paths;
  const auto plate = static_cast<std::uint16_t>(mesh.part_names.size() - 1);  // the last part
  int hidden = 0;
  for (int first = paths.path(0).first_child; first >= 0; first = paths.path(first).next_sibling) {
    EXPECT_TRUE(paths.obstacles(first, 0).empty());  // the receiver sees what it illuminates
    for (int second = paths.path(first).first_child; second >= 0; second = paths.path(second).next_sibling)
      for (const Obstacle& obstacle : paths.obstacles(second, 0))
        hidden += scene.target.facets()[obstacle.facet].part == plate;
  }
  EXPECT_GT(hidden, 0);
}

// The method of rays against closed forms, the method of beams, and laws.

using Matrix = std::array<Complex, 4>;

TracingSettings by(SolverMethod method, bool edges = false, double spacing_m = 0) {
  return {0, kDefaultBounces, edges, {}, method, spacing_m};
}
const TracingSettings kByRays = by(SolverMethod::kRays), kByBeams = by(SolverMethod::kBeams);

Matrix echo_by(const TracingSettings& settings, const Scatterer& target, const RadarBasis& basis, double k) {
  return scattering_matrices(target, monostatic(basis), std::array{k}, settings)[0];
}

double relative_difference(const Matrix& a, const Matrix& b) {
  double difference = 0;
  for (std::size_t i = 0; i < 4; ++i) difference = std::max(difference, std::abs(a[i] - b[i]));
  return difference / largest(b);
}

TEST(Rays, APlateIsExactPhysicalOpticsToSixtyDegreesAtAnySpacing) {
  const double k = wavenumber(10e9), length = 0.5, width = 0.3;
  const Scatterer plate(make_plate(length, width));
  for (const double spacing_m : {0.3, 0.03, 0.003}) {
    for (double theta = 0.5; theta < 60; theta += 3.3) {
      const Vec3 r = direction(theta, 0);
      // -jk/2pi A cos(theta) sinc(k length sin(theta)) at the centre of the plate.
      const double x = k * length * std::sin(radians(theta));
      const Complex exact = Complex(0, -k / (2 * kPi)) * length * width * std::cos(radians(theta)) * std::sin(x) / x;
      const Matrix s = echo_by(by(SolverMethod::kRays, false, spacing_m), plate, radar_basis(r), k);
      EXPECT_LT(std::abs(s[kVvChannel] - exact), 1e-9) << theta << " deg, " << spacing_m;
    }
  }
}

// Within 0.1 dB of beams at the default spacing over the main lobes; in lobes 25 dB below, within that of the peak.
TEST(Rays, CanonicalBodiesAreWithinATenthOfADecibelOfBeams) {
  const struct {
    const char* name;
    TriangleMesh mesh;
    double ghz;
  } bodies[] = {{"dihedral", make_dihedral(0.4, 0.3, radians(90)), 10},
                {"triangular trihedral", make_triangular_trihedral(0.5), 10},
                {"square trihedral", make_square_trihedral(0.4), 10},
                {"sphere", make_sphere(0.5, 3), 10},
                {"cylinder", make_cylinder(0.2, 0.6, 96), 10}};
  for (const auto& [name, mesh, ghz] : bodies) {
    const Scatterer target(mesh);
    const double k = wavenumber(ghz * 1e9);
    double peak = 0;
    for (const double azimuth : {-20.0, 0.0, 5.0, 20.0, 45.0, 65.0}) {
      for (const double elevation : {0.0, 20.0, 35.0}) {
        const RadarBasis basis = radar_basis(direction(azimuth, elevation));
        const Matrix rays = echo_by(kByRays, target, basis, k), beams = echo_by(kByBeams, target, basis, k);
        peak = std::max(peak, largest(beams));
        for (const int channel : {kHhChannel, kVvChannel})
          EXPECT_LT(std::abs(rays[channel] - beams[channel]), 0.0115 * std::max(largest(beams), 0.056 * peak))
              << name << ' ' << azimuth << ' ' << elevation << ' ' << dbsm(rays[channel]) << ' '
              << dbsm(beams[channel]);
      }
    }
  }
}

// Faces drawn from both sides, the backs cut otherwise: by both methods the echo of the sheet, for any cut.
TEST(Rays, ASheetDrawnFromBothSidesHasTheEchoOfTheSheetByBothMethods) {
  const std::string meshes = SEAGLINT_SOURCE_DIR "/tests/cases/meshes/";
  const double k = wavenumber(10e9);
  const RadarBasis into = radar_basis(direction(45, 30)), beside = radar_basis(direction(130, 10));
  const TriangleMesh sheet = read_mesh(meshes + "trihedral_sheet.obj");
  TriangleMesh backs = sheet;
  for (auto& triangle : backs.triangles) std::swap(triangle[1], triangle[2]);
  std::vector<TriangleMesh> drawn_twice{read_mesh(meshes + "trihedral_two_sided.obj")};
  Random random({3, Stream::kTest, 1});
  for (int level = 0; level < 2; ++level) {
    backs = renumbered(cut_in_four(backs), random);
    drawn_twice.push_back(backs);
    drawn_twice.back().append(sheet);
    drawn_twice.push_back(sheet);
    drawn_twice.back().append(backs);
  }
  for (const SolverMethod method : {SolverMethod::kRays, SolverMethod::kBeams}) {
    const Matrix alone = echo_by(by(method, true), Scatterer(repair(sheet)), into, k),
                 outside = echo_by(by(method, true), Scatterer(repair(sheet)), beside, k);
    // The values that the case was reported with.
    EXPECT_NEAR(dbsm(alone[kHhChannel]), 44.88, 0.1);
    EXPECT_NEAR(dbsm(alone[kVvChannel]), 44.98, 0.1);
    for (const TriangleMesh& mesh : drawn_twice) {
      const Scatterer target(repair(welded(mesh)));
      EXPECT_LT(relative_difference(echo_by(by(method, true), target, into, k), alone), 1e-6);
      EXPECT_LT(relative_difference(echo_by(by(method, true), target, beside, k), outside), 1e-6);
    }
  }
}

// The two sides are of different materials and stay; a ray hits the side that faces it, whichever is first in the file.
TEST(Rays, ASheetOfTwoMaterialsScattersByTheSideThatIsSeen) {
  const double k = wavenumber(10e9);
  const RadarBasis into = radar_basis(direction(45, 30));
  MaterialSpec dull;
  dull.name = "dull";
  dull.kind = SurfaceKind::kImpedance;
  dull.resistance = 0.5;
  for (const bool recut : {false, true}) {
    TriangleMesh mesh = read_mesh(SEAGLINT_SOURCE_DIR "/tests/cases/meshes/trihedral_two_sided.obj");
    if (!recut) {
      for (std::size_t t = 0; t < 6; ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        mesh.triangles[6 + t] = {c, b, a};
      }
    }
    mesh.materials.push_back({"dull"});
    for (const bool front_is_dull : {false, true}) {
      for (std::size_t t = 0; t < 12; ++t) mesh.triangle_material[t] = (t < 6) == front_is_dull ? 1 : 0;
      const Scatterer target(repair(mesh), {MaterialSpec{}, dull});
      const Matrix rays = echo_by(kByRays, target, into, k), beams = echo_by(kByBeams, target, into, k);
      EXPECT_LT(relative_difference(rays, beams), 0.0115) << recut << front_is_dull;  // 0.1 dB
      EXPECT_EQ(dbsm(rays[kVvChannel]) > 44, !front_is_dull);
    }
  }
}

// Slivers below the smallest patch, which the borders of tiles cut off, leave 1e-5.
TEST(Rays, ObstaclesOfTheExitPathAreCutOutAsTheVisibleSurfaceOfBeamsDoes) {
  const Scatterer target(stepped_corner());
  const double k = wavenumber(16e9);
  for (const double azimuth : {20.0, 35.0, 50.0}) {
    const RadarBasis basis = radar_basis(direction(azimuth, 25));
    EXPECT_LT(relative_difference(echo_by(kByRays, target, basis, k), echo_by(kByBeams, target, basis, k)), 3e-5);
    EXPECT_LT(relative_difference(echo_by(by(SolverMethod::kRays, true), target, basis, k),
                                  echo_by(by(SolverMethod::kBeams, true), target, basis, k)),
              2e-3)
        << "with edges, azimuth " << azimuth;
  }
}

TEST(Rays, TwoAntennasCoatingsAndAFiniteRangeGiveTheEchoOfBeams) {
  TriangleMesh mesh = stepped_corner();
  for (std::size_t i = 0; i < mesh.triangle_material.size(); ++i) mesh.triangle_material[i] = i % 4 < 2 ? 0 : 1;
  mesh.materials = {{"metal"}, {"coat"}};
  MaterialSpec coat;
  coat.kind = SurfaceKind::kImpedance;
  coat.name = "coat";
  coat.resistance = 0.5;
  coat.reactance = 0.2;
  const Scatterer target(mesh, {MaterialSpec{}, coat});
  const double k = wavenumber(10e9);
  const BistaticGeometry pair = bistatic(radar_basis(direction(35, 25)), radar_basis(direction(48, 15)));
  // Slivers at the borders of tiles as above. At a finite range amplitudes are frozen over each footprint
  // (points/decomposition.cpp), and tiles divide footprints: 0.018 at 40 m, in proportion to 1 / range.
  for (const double range_m : {0.0, 400.0}) {
    const auto of = [&](const TracingSettings& settings) {
      return scattering_matrices(target, pair, std::array{k}, settings, 1, {range_m})[0];
    };
    EXPECT_LT(relative_difference(of(kByRays), of(kByBeams)), range_m > 0 ? 3e-3 : 3e-5) << range_m;
  }
}

TEST(Rays, EqualBytesForAnyNumberOfThreads) {
  const Scatterer ship(read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb"));
  const RadarBasis basis = radar_basis(direction(30, 2));
  const std::array k{wavenumber(9e9), wavenumber(9.1e9)};
  const TracingSettings settings = by(SolverMethod::kRays, true, 0.1);
  const Matrices one = scattering_matrices(ship, monostatic(basis), k, settings, 1);
  EXPECT_EQ(one, scattering_matrices(ship, monostatic(basis), k, settings, 3));
}

// Relative L2 difference over two elements and six frequencies of 200 MHz at 16 GHz.
TEST(Rays, TheShipIsWithinMinus25DecibelsOfBeams) {
  const Scatterer ship(read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb"));
  std::vector<double> k;
  for (int q = 0; q < 6; ++q) k.push_back(wavenumber(16e9 + 200e6 * q / 6));
  for (const double azimuth : {10.0, 50.0}) {
    const BistaticGeometry geometry = monostatic(radar_basis(direction(azimuth, 0)));
    const Matrices rays = scattering_matrices(ship, geometry, k, by(SolverMethod::kRays, true), 2),
                   beams = scattering_matrices(ship, geometry, k, by(SolverMethod::kBeams, true), 2);
    RelativeError error;
    error.add_co_polar(rays, beams);
    EXPECT_LT(error.db(), -25) << azimuth;
  }
}

}  // namespace
}  // namespace seaglint

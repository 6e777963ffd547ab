// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/decoy/make_decoy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/placement/waterline.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/refusal.h"

namespace seaglint {
namespace {

constexpr DecoyKind kKinds[] = {DecoyKind::kIcosahedral, DecoyKind::kOctahedral, DecoyKind::kTrihedralCluster,
                                DecoyKind::kTrihedral, DecoyKind::kDihedral};
constexpr double kRounding = 1e-12;  // of doubles, for sums of a few hundred terms of order one

const char* name_of(DecoyKind kind) { return kDecoyKindNames[static_cast<int>(kind)]; }

DecoySpec of_kind(DecoyKind kind) {
  DecoySpec spec;
  spec.kind = kind;
  return spec;
}

// Every kind with every shape of its panels.
std::vector<DecoySpec> all_shapes() {
  std::vector<DecoySpec> specs;
  for (const DecoyKind kind : kKinds) specs.push_back(of_kind(kind));
  for (const DecoyKind kind : {DecoyKind::kOctahedral, DecoyKind::kTrihedral})
    for (const DecoyPanel panel : {DecoyPanel::kSquare, DecoyPanel::kCircular}) {
      specs.push_back(of_kind(kind));
      specs.back().panel = panel;
    }
  return specs;
}

TriangleMesh part_named(const TriangleMesh& mesh, const std::string& name) {
  const auto at = std::find(mesh.part_names.begin(), mesh.part_names.end(), name);
  EXPECT_NE(at, mesh.part_names.end()) << name;
  return part_of(mesh, static_cast<std::size_t>(at - mesh.part_names.begin()));
}

bool is_solid(const std::string& part) {
  for (const char* name : {"float", "raft", "floor", "mast", "tether", "frame_", "tube_", "joints"})
    if (part.starts_with(name)) return true;
  return false;
}

TEST(PerfectDecoy, IcosahedralOneIsTheIcosahedralReflector) {
  const TriangleMesh decoy = make_decoy({}), reflector = make_icosahedral_reflector(0.372 * std::sqrt(2.0));
  EXPECT_EQ(decoy.vertices, reflector.vertices);
  EXPECT_EQ(decoy.triangles, reflector.triangles);
  EXPECT_EQ(decoy.part_names, reflector.part_names);
  EXPECT_EQ(decoy.triangle_part, reflector.triangle_part);
  EXPECT_TRUE(decoy.corner_normals.empty());
}

TEST(PerfectDecoy, HasTheAreaOfItsPanels) {
  for (const DecoySpec& spec : all_shapes()) {
    // Of a square: 1; of a quarter of a polygon of 64 sides: 16 sin(90 deg / 16) / 2.
    const double panel = spec.kind == DecoyKind::kDihedral || spec.panel == DecoyPanel::kSquare ? 1
                         : spec.panel == DecoyPanel::kCircular                                  ? 8 * std::sin(kPi / 32)
                                                                                                : 0.5;
    EXPECT_NEAR(surface_area(make_decoy(spec)), decoy_panel_count(spec) * panel * spec.leg_m * spec.leg_m, kRounding)
        << name_of(spec.kind);
  }
}

TEST(PerfectDecoy, HasOneTrihedronTowardsItsBow) {
  for (DecoySpec spec : all_shapes()) {
    if (spec.kind == DecoyKind::kDihedral) continue;
    for (const DecoyPose pose : {DecoyPose::kRainCatcher, DecoyPose::kPointUp}) {
      if (pose == DecoyPose::kPointUp && spec.kind != DecoyKind::kOctahedral) continue;
      spec.pose = pose;
      bool is_ahead = false;
      for (const Trihedron& t : decoy_reflector(spec).trihedra) {
        const Vec3 boresight = (t.legs[0] + t.legs[1] + t.legs[2]).normalized();
        is_ahead |= std::abs(boresight.y()) < kRounding && boresight.x() > 0.5;
        EXPECT_NEAR(t.legs[0].cross(t.legs[1]).dot(t.legs[2]), std::pow(spec.leg_m, 3), kRounding)
            << name_of(spec.kind);
      }
      EXPECT_TRUE(is_ahead) << name_of(spec.kind);
    }
  }
}

// A cell of the rain catcher faces upwards, six of the others 19.47 deg above and below the horizon; the other pose has
// a corner straight up.
TEST(PerfectDecoy, OctahedralOneHasItsPose) {
  DecoySpec spec = of_kind(DecoyKind::kOctahedral);
  std::map<int, int> count;
  for (const Trihedron& t : decoy_reflector(spec).trihedra) {
    const double sine = (t.legs[0] + t.legs[1] + t.legs[2]).normalized().z();
    ++count[static_cast<int>(std::lround(3 * sine))];
    EXPECT_NEAR(3 * sine, std::round(3 * sine), 10 * kRounding);
  }
  EXPECT_EQ(count, (std::map<int, int>{{-3, 1}, {-1, 3}, {1, 3}, {3, 1}}));
  EXPECT_NEAR(bounds(make_decoy(spec)).upper.z(), spec.leg_m / std::sqrt(3.0), kRounding);
  spec.pose = DecoyPose::kPointUp;
  EXPECT_NEAR(bounds(make_decoy(spec)).upper.z(), spec.leg_m, kRounding);
}

TEST(PerfectDecoy, TrihedraOfARingAreApartFromEachOtherAndTheMast) {
  DecoySpec spec = of_kind(DecoyKind::kTrihedralCluster);
  for (spec.cells = 3; spec.cells <= 12; ++spec.cells)
    for (const double elevation : {-45.0, 0.0, 30.0, 45.0}) {
      spec.boresight_elevation_deg = elevation;
      const TriangleMesh mesh = make_decoy(spec);
      ASSERT_EQ(mesh.part_names.size(), static_cast<std::size_t>(spec.cells));
      const Bounds box = bounds(mesh);
      EXPECT_NEAR(box.upper.z(), -box.lower.z(), kRounding);
      for (const Vec3& p : part_of(mesh, 0).vertices) {
        EXPECT_GT(p.x(), 0.05 * spec.leg_m);
        EXPECT_LT(std::abs(p.y()), p.x() * std::tan(kPi / spec.cells));
      }
    }
}

TEST(DecoySeam, ErrorOfOneRightAngleIsExact) {
  DecoySpec spec = of_kind(DecoyKind::kTrihedral);
  for (const double error : {-2.0, 0.5, 1.0, 5.0})
    for (std::size_t seam = 0; seam < 3; ++seam) {
      spec.seam_errors_deg = {0, 0, 0};
      spec.seam_errors_deg[seam] = error;
      const auto [apex, legs, part] = decoy_reflector(spec).trihedra[0];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 first = legs[k].cross(legs[(k + 1) % 3]), second = legs[k].cross(legs[(k + 2) % 3]);
        EXPECT_NEAR(degrees(std::acos(first.dot(second) / (first.norm() * second.norm()))),
                    90 + (k == seam ? error : 0), 1e-10);
        EXPECT_NEAR(legs[k].norm(), spec.leg_m, kRounding);
      }
    }
}

// Angles between the panels of all trihedra. 3 standard errors of a standard deviation from n independent angles are
// 3 / sqrt(2 n); the neglected second order is the error squared, 0.01 of it.
TEST(DecoyAngles, HaveTheirStandardDeviation) {
  for (const DecoyKind kind : kKinds) {
    DecoySpec spec = of_kind(kind);
    spec.angle_error_deg = 0.5;
    double sum = 0, squares = 0;
    int count = 0, independent = 0;
    for (spec.seed = 0; spec.seed < 200; ++spec.seed) {
      const DecoyReflector reflector = decoy_reflector(spec);
      const auto add = [&](const Vec3& first, const Vec3& second) {
        const double error = degrees(std::acos(first.dot(second) / (first.norm() * second.norm()))) - 90;
        sum += error;
        squares += error * error;
        ++count;
      };
      for (const Trihedron& t : reflector.trihedra)
        for (std::size_t k = 0; k < 3; ++k)
          add(t.legs[k].cross(t.legs[(k + 1) % 3]), t.legs[k].cross(t.legs[(k + 2) % 3]));
      if (kind == DecoyKind::kDihedral) add(reflector.panels[0].legs[1], reflector.panels[1].legs[1]);
      // An octahedral reflector has twelve corners of panels, each the angle of two trihedra; those in one plane add to
      // 360 deg.
      independent += kind == DecoyKind::kOctahedral ? 9 : kind == DecoyKind::kDihedral ? 1 : decoy_panel_count(spec);
    }
    EXPECT_NEAR(std::sqrt(squares / count), 0.5, 0.5 * (3 / std::sqrt(2.0 * independent) + 0.01)) << name_of(kind);
    EXPECT_NEAR(sum / count, 0, 0.5 * (3 / std::sqrt(independent) + 0.01)) << name_of(kind);
  }
}

TEST(DecoyAngles, LeavePanelsFlatAndTheIcosahedralReflectorClosed) {
  DecoySpec spec;
  spec.angle_error_deg = 1;
  const TriangleMesh mesh = make_decoy(spec);
  ASSERT_EQ(mesh.triangles.size(), 60u);
  const Topology topology = topology_of(mesh);
  EXPECT_EQ(topology.count(EdgeKind::kManifold), topology.edges.size());
  // The rims stay where they are.
  const TriangleMesh perfect = make_decoy({});
  for (std::size_t i = 0; i < 12; ++i) {
    const Vec3& rim = perfect.vertices[i];
    EXPECT_TRUE(std::any_of(mesh.vertices.begin(), mesh.vertices.end(),
                            [&](const Vec3& p) { return (p - rim).norm() < kRounding; }));
  }
}

// Mean square height over the flat panels, of 50 seeds. Its standard deviation is sqrt(2 / (3 n)) for n panels of three
// normal amplitudes, of which it allows three, and 2 % for the mean over the vertices in place of the surface.
TEST(DecoySurface, HasItsRmsAndStraightSeams) {
  for (DecoySpec spec : all_shapes()) {
    if (spec.kind == DecoyKind::kIcosahedral || spec.kind == DecoyKind::kTrihedralCluster) continue;
    spec.surface_error_mm = 1;
    double squares = 0, area = 0;
    int panels = 0;
    for (spec.seed = 0; spec.seed < 50; ++spec.seed) {
      const TriangleMesh mesh = make_decoy(spec);
      const DecoyReflector reflector = decoy_reflector(spec);
      for (const TrihedronPanel& panel : reflector.panels) {
        const Vec3 normal = panel.legs[0].cross(panel.legs[1]).normalized();
        const TriangleMesh part = part_named(mesh, panel.part);
        for (std::size_t t = 0; t < part.triangles.size(); ++t) {
          const double size = area_vector(part, t).norm();
          for (const std::uint32_t v : part.triangles[t]) {
            const double height = (part.vertices[v] - panel.corner).dot(normal);
            squares += size * height * height / 3;
            const Vec3 place = part.vertices[v] - panel.corner;
            if (std::min(place.dot(panel.legs[0]), place.dot(panel.legs[1])) < 1e-9) {
              EXPECT_LT(std::abs(height), 1e-9) << "at a seam";
            }
          }
          area += size;
        }
        ++panels;
      }
    }
    EXPECT_NEAR(1e6 * squares / area, 1, 3 * std::sqrt(2.0 / (3 * panels)) + 0.02) << name_of(spec.kind);
  }
}

TEST(DecoyDent, HasItsDepthInAsManyPanels) {
  for (const DecoySpec& shape : all_shapes()) {
    if (shape.kind == DecoyKind::kIcosahedral || shape.kind == DecoyKind::kTrihedralCluster) continue;
    DecoySpec spec = shape;
    spec.dented_panels = 2;
    spec.dent_depth = 0.03;
    const TriangleMesh mesh = make_decoy(spec);
    int dented = 0;
    for (const TrihedronPanel& panel : decoy_reflector(spec).panels) {
      const Vec3 normal = panel.legs[0].cross(panel.legs[1]).normalized();
      double depth = 0;
      for (const Vec3& p : part_named(mesh, panel.part).vertices)
        depth = std::max(depth, std::abs((p - panel.corner).dot(normal)));
      // The node nearest to the middle of a triangle is (3, 3, 2) / 8, others are nearer to theirs.
      if (depth > 1e-9) {
        ++dented;
        EXPECT_NEAR(depth, 0.03 * spec.leg_m, 0.03 * spec.leg_m * (1 - std::pow(27 * 18 / 512.0, 2)) + kRounding)
            << name_of(spec.kind);
      }
    }
    EXPECT_EQ(dented, 2) << name_of(spec.kind);
  }
}

TEST(DecoyPanels, AreMissingInTheirNumber) {
  for (const DecoySpec& shape : all_shapes()) {
    DecoySpec spec = shape;
    const double whole = surface_area(make_decoy(spec));
    for (spec.missing_panels = 1; spec.missing_panels < std::min(4, decoy_panel_count(spec)); ++spec.missing_panels)
      EXPECT_NEAR(surface_area(make_decoy(spec)), whole * (1 - double(spec.missing_panels) / decoy_panel_count(spec)),
                  kRounding)
          << name_of(spec.kind);
  }
}

// A seam of two panels of length s has the area of its fillet, s pi r / 2, in place of two strips, 2 s r; dihedral.
TEST(DecoyFillet, HasItsRadius) {
  DecoySpec spec = of_kind(DecoyKind::kDihedral);
  spec.rounding_mm = 20;
  const double leg = spec.leg_m, r = 0.02, sides = 6, arc = 2 * sides * std::sin(0.25 * kPi / sides);
  EXPECT_NEAR(surface_area(make_decoy(spec)), 2 * leg * (leg - r) + leg * r * arc, kRounding);
}

// Each seam is filled by r^2 less a quarter of a polygon of 24 sides, over less than the leg and more than the leg less
// r at the apex and up to 2 r at the opening.
TEST(DecoyFillet, FillsSeamsAndApexesOfAClosedReflector) {
  DecoySpec spec;
  const double perfect = enclosed_volume(make_decoy(spec)), leg = spec.leg_m;
  for (const double r : {0.005, 0.02}) {
    spec.rounding_mm = 1e3 * r;
    const TriangleMesh mesh = make_decoy(spec);
    const Topology topology = topology_of(mesh);
    EXPECT_EQ(topology.count(EdgeKind::kManifold), topology.edges.size());
    const double section = (1 - 3 * std::sin(kPi / 12)) * r * r, filled = enclosed_volume(mesh) - perfect;
    EXPECT_LT(filled, 60 * section * leg);
    EXPECT_GT(filled, 60 * section * (leg - 3 * r));
  }
}

TEST(DecoyFillet, HasNormalsOfItsCylindersAndSpheres) {
  for (DecoySpec spec : all_shapes()) {
    spec.rounding_mm = 15;
    const TriangleMesh mesh = make_decoy(spec);
    ASSERT_EQ(mesh.corner_normals.size(), mesh.triangles.size());
    // Half the turn of a fillet's side; a sixth of the quarter sphere's sides is up to 1.3 times as long.
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      EXPECT_LT(normal_deviation(mesh, t), radians(15 * 1.3)) << name_of(spec.kind);
  }
}

// Everything at once.
DecoySpec battered(DecoyKind kind, std::uint64_t seed) {
  DecoySpec spec = of_kind(kind);
  spec.seed = seed;
  spec.angle_error_deg = 0.7;
  spec.surface_error_mm = 2;
  spec.rounding_mm = 12;
  spec.dented_panels = 1;
  spec.missing_panels = 1;
  spec.inflatable = seed % 2 == 0;
  if (!spec.inflatable) spec.frame_mm = 10;
  if (kind == DecoyKind::kOctahedral || kind == DecoyKind::kTrihedral) spec.panel = static_cast<DecoyPanel>(seed % 3);
  if (kind == DecoyKind::kOctahedral && seed % 5 == 0) spec.pose = DecoyPose::kPointUp;
  spec.support = static_cast<DecoySupport>(seed % 4);
  if (spec.support != DecoySupport::kNone) spec.tether_m = 4;
  if (spec.support == DecoySupport::kFloat && seed % 8 == 1) spec.float_shape = DecoyFloat::kSphere;
  spec.mast_m = 1.3;
  return spec;
}

TEST(BatteredDecoys, AreSoundMeshesOfModerateSizeForFiftySeeds) {
  for (const DecoyKind kind : kKinds) {
    std::size_t most = 0;
    double longest_s = 0;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      SCOPED_TRACE(testing::Message() << name_of(kind) << ", seed " << seed);
      const DecoySpec spec = battered(kind, seed);
      const auto start = std::chrono::steady_clock::now();
      const TriangleMesh mesh = make_decoy(spec);
      longest_s = std::max(longest_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      most = std::max(most, mesh.triangles.size());
      const Topology topology = topology_of(mesh);
      EXPECT_TRUE(topology.degenerate.empty());
      EXPECT_EQ(topology.count(EdgeKind::kInconsistent), 0u);
      for (std::size_t p = 0; p < mesh.part_names.size(); ++p)
        if (is_solid(mesh.part_names[p])) {
          EXPECT_TRUE(topology.part_closed[p]) << mesh.part_names[p];
          EXPECT_GT(enclosed_volume(part_of(mesh, p)), 0) << mesh.part_names[p];
        }
      if (seed < 3) {
        const TriangleMesh again = make_decoy(spec);
        EXPECT_EQ(mesh.vertices, again.vertices);
        EXPECT_EQ(mesh.triangles, again.triangles);
        EXPECT_EQ(mesh.corner_normals, again.corner_normals);
      }
    }
    std::printf("%s: at most %zu triangles, %.3f s\n", name_of(kind), most, longest_s);
    EXPECT_LT(most, 60000u);
    EXPECT_LT(longest_s, 2);
  }
}

TEST(BatteredDecoys, IcosahedralOneIsClosedWithoutMissingPanels) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    DecoySpec spec = battered(DecoyKind::kIcosahedral, seed);
    spec.missing_panels = 0;
    spec.inflatable = false;
    spec.frame_mm = 0;
    spec.support = DecoySupport::kNone;
    spec.float_shape = DecoyFloat::kDisc;
    spec.tether_m = 0;
    const TriangleMesh mesh = make_decoy(spec);
    const Topology topology = topology_of(mesh);
    EXPECT_EQ(topology.count(EdgeKind::kManifold), topology.edges.size()) << seed;
    EXPECT_GT(enclosed_volume(mesh), 0);
  }
}

TEST(BatteredDecoys, DifferByTheirSeed) {
  for (const DecoyKind kind : kKinds)
    EXPECT_NE(make_decoy(battered(kind, 1)).vertices, make_decoy(battered(kind, 5)).vertices) << name_of(kind);
}

double largest_radius(const TriangleMesh& mesh) {
  double radius = 0;
  for (const Vec3& vertex : mesh.vertices) radius = std::max(radius, vertex.norm());
  return radius;
}

// The range window of a data set contains every individual.
TEST(BatteredDecoys, OfALayoutAreIndividualsWithinTheBoundOfTheirDisplacement) {
  for (const DecoyKind kind : kKinds) {
    SCOPED_TRACE(name_of(kind));
    DecoySpec spec = battered(kind, 3);
    const double bound = largest_radius(make_decoy(without_imperfections(spec))) + largest_displacement_m(spec);
    EXPECT_EQ(decoy_of_body(spec, 0), spec);
    EXPECT_EQ(decoy_of_body(without_imperfections(spec), 7), without_imperfections(spec));
    std::set<std::uint64_t> seeds;
    for (std::size_t body = 0; body < 20; ++body) {
      const DecoySpec one = decoy_of_body(spec, body);
      EXPECT_TRUE(seeds.insert(one.seed).second);
      EXPECT_LE(largest_radius(make_decoy(one)), bound);
    }
  }
}

// A rod through the middle of every outer edge, tubes in place of bars.
TEST(DecoyFrame, HasOneBarOrTubeForEachOuterEdge) {
  for (const auto& [kind, count] : {std::pair{DecoyKind::kIcosahedral, 30},
                                    {DecoyKind::kOctahedral, 12},
                                    {DecoyKind::kTrihedralCluster, 15},
                                    {DecoyKind::kTrihedral, 3},
                                    {DecoyKind::kDihedral, 6}}) {
    DecoySpec bars = of_kind(kind);
    bars.frame_mm = 12;
    DecoySpec tubes = of_kind(kind);
    tubes.rounding_mm = 30;
    tubes.inflatable = true;
    for (const auto& [spec, name] : {std::pair{bars, "frame_"}, {tubes, "tube_"}}) {
      const TriangleMesh mesh = make_decoy(spec);
      EXPECT_EQ(std::count_if(mesh.part_names.begin(), mesh.part_names.end(),
                              [&, start = name](const std::string& part) { return part.starts_with(start); }),
                count);
    }
    // A bar of 12 mm along an edge: its volume is that of a prism.
    const double edge = kind == DecoyKind::kDihedral ? bars.leg_m : bars.leg_m * std::sqrt(2.0);
    EXPECT_NEAR(enclosed_volume(part_named(make_decoy(bars), "frame_01")), 0.012 * 0.012 * edge, kRounding);
  }
}

TEST(DecoySupports, StandInTheWaterUnderTheReflector) {
  for (const DecoyKind kind : kKinds)
    for (const DecoySupport support : {DecoySupport::kFloat, DecoySupport::kRaft, DecoySupport::kTow})
      for (const DecoyFloat shape : {DecoyFloat::kDisc, DecoyFloat::kSphere}) {
        DecoySpec spec = of_kind(kind);
        if (shape == DecoyFloat::kSphere && support == DecoySupport::kRaft) continue;
        spec.support = support;
        spec.float_shape = shape;
        spec.mast_m = 1;
        spec.tether_m = 3;
        SCOPED_TRACE(testing::Message() << name_of(kind) << " on " << kDecoySupportNames[static_cast<int>(support)]);
        const TriangleMesh mesh = make_decoy(spec), mast = part_named(mesh, "mast"), line = part_named(mesh, "tether");
        const Bounds body = bounds(part_named(mesh, support == DecoySupport::kRaft ? "raft" : "float"));
        EXPECT_LT(body.lower.z(), -1);
        EXPECT_GT(body.upper.z(), -1);
        EXPECT_LT(bounds(mast).lower.z(), body.upper.z());
        EXPECT_GT(bounds(mast).upper.z(), body.upper.z());
        // The line ends at the water, ahead or astern, within the sagitta of its sections.
        const Bounds end = bounds(line);
        EXPECT_NEAR(end.lower.z(), -1, 0.0061);
        EXPECT_GT(support == DecoySupport::kTow ? end.upper.x() : -end.lower.x(), 3);

        // Cut off at the water, every solid is closed there.
        const AboveWater above = above_water(mesh, -1);
        EXPECT_EQ(above.below.open_m, 0);
        EXPECT_GT(above.below.depth_m, 0.05);
        const Topology topology = topology_of(above.mesh);
        for (std::size_t p = 0; p < above.mesh.part_names.size(); ++p) {
          if (is_solid(above.mesh.part_names[p])) {
            EXPECT_TRUE(topology.part_closed[p]) << above.mesh.part_names[p];
          }
        }
      }
}

// A polygon of n sides inscribed in a circle of radius a has the area pi a^2 sinc(2 pi / n). In both directions of the
// sphere n = 64 or a little more: a loss of 0.16 to 0.32 %.
TEST(LensMesh, IsASphereWhoseCapEndsAtItsAngleAndWhoseProjectionsAreDiscs) {
  for (const double cap_deg : {20.0, 70.0, 90.0}) {
    DecoySpec spec = of_kind(DecoyKind::kLuneburgLens);
    spec.leg_m = 0.3;
    spec.cap_half_angle_deg = cap_deg;
    spec.boresight_elevation_deg = 25;
    const TriangleMesh mesh = make_decoy(spec);
    EXPECT_EQ(mesh.part_names, (std::vector<std::string>{"lens", "cap"}));
    EXPECT_EQ(topology_of(mesh).count(EdgeKind::kManifold), topology_of(mesh).edges.size());
    const Vec3 axis(std::cos(radians(25)), 0, std::sin(radians(25)));
    for (const Vec3& x : mesh.vertices) EXPECT_NEAR(x.norm(), 0.3, kRounding);
    const double rim = -0.3 * std::cos(radians(cap_deg));
    for (const Vec3& x : part_named(mesh, "lens").vertices) EXPECT_GT(axis.dot(x), rim - kRounding);
    for (const Vec3& x : part_named(mesh, "cap").vertices) EXPECT_LT(axis.dot(x), rim + kRounding);
    for (const Vec3& view : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0.3, 0.8, -0.2), Vec3(0.9, 0.2, 0.4)}) {
      double area = 0;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        area += std::max(0.0, area_vector(mesh, t).dot(view.normalized()));
      EXPECT_LT(area, kPi * 0.09);
      EXPECT_GT(area, kPi * 0.09 * (1 - 0.0035));
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Material& material = mesh.materials[mesh.triangle_material[t]];
      EXPECT_EQ(material.name, mesh.triangle_part[t] == 0 ? "luneburg_lens" : "pec");
    }
  }
}

TEST(LensMesh, StandsOnEverySupport) {
  for (const DecoySupport support : {DecoySupport::kFloat, DecoySupport::kRaft, DecoySupport::kTow}) {
    DecoySpec spec = of_kind(DecoyKind::kLuneburgLens);
    spec.leg_m = 0.15;
    spec.lens_loss_db = 0.5;
    spec.support = support;
    spec.tether_m = 3;
    const TriangleMesh mesh = make_decoy(spec);
    // Below a facet, which is lower than the sphere by its sagitta.
    EXPECT_NEAR(bounds(part_named(mesh, "mast")).upper.z(), -0.15, 0.15 * (1 - std::cos(kPi / 64)));
    EXPECT_EQ(above_water(mesh, -spec.mast_m).below.open_m, 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Material& material = mesh.materials[mesh.triangle_material[t]];
      EXPECT_EQ(material.name, mesh.triangle_part[t] == 0 ? "luneburg_lens_0.5dB" : "pec");
    }
  }
}

TEST(DecoySpecs, WithContradictionsAreRefusedWithTheirBound) {
  const auto refusal = [](const std::function<void(DecoySpec&)>& change, DecoyKind kind = DecoyKind::kIcosahedral) {
    DecoySpec spec = of_kind(kind);
    change(spec);
    return refusal_of([&] { make_decoy(spec); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([](DecoySpec& s) { s.leg_m = 6; }), "leg_m: value 6: must be within 0.05 and 5");
  EXPECT_HAS(refusal([&](DecoySpec& s) { s.leg_m = nan; }), "leg_m");
  EXPECT_EQ(refusal([](DecoySpec& s) { s.missing_panels = 60; }), "missing_panels: value 60: must be within 0 and 59");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.missing_panels = 59, s.dented_panels = 2; }),
             "value 2: must be within 0 and 1");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.rounding_mm = 75; }), "within 0.1 and 74.4");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.frame_mm = 38; }), "within 0.1 and 37.2");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.surface_error_mm = 8; }), "within 0 and 7.44");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.panel = DecoyPanel::kSquare; }), "octahedral and trihedral only");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.pose = DecoyPose::kPointUp; }), "octahedral only");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.cells = 4; }), "trihedral_cluster only");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.cells = 13; }, DecoyKind::kTrihedralCluster), "within 3 and 12");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.seam_errors_deg[1] = 1; }), "trihedral only");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.boresight_elevation_deg = 5; }), "dihedral only");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.inflatable = true; }), "needs rounding_mm");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.inflatable = true, s.rounding_mm = 20, s.frame_mm = 10; }), "tubes");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.support = DecoySupport::kTow; }), "tether_m");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.tether_m = 2; }), "support");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.float_m = 2; }), "support");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.float_shape = DecoyFloat::kSphere; }), "support");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.support = DecoySupport::kFloat, s.mast_m = 0.5; }), "must be above 0.6");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.cap_half_angle_deg = 60; }), "cap_half_angle_deg: not allowed here");
  EXPECT_HAS(refusal([](DecoySpec& s) { s.lens_loss_db = 1; }), "luneburg_lens only");
  const auto of_lens = [&](const std::function<void(DecoySpec&)>& change) {
    return refusal(change, DecoyKind::kLuneburgLens);
  };
  EXPECT_EQ(of_lens([](DecoySpec& s) { s.cap_half_angle_deg = 95; }),
            "cap_half_angle_deg: value 95: must be within 20 and 90");
  EXPECT_HAS(of_lens([](DecoySpec& s) { s.lens_loss_db = 11; }), "within 0 and 10");
  EXPECT_EQ(of_lens([](DecoySpec& s) { s.angle_error_deg = 1; }),
            "angle_error_deg: not allowed here: applies to corner reflectors only");
  EXPECT_HAS(of_lens([](DecoySpec& s) { s.surface_error_mm = 1; }), "surface_error_mm: not allowed here");
  EXPECT_HAS(of_lens([](DecoySpec& s) { s.rounding_mm = 5; }), "rounding_mm: not allowed here");
  EXPECT_HAS(of_lens([](DecoySpec& s) { s.inflatable = true; }), "inflatable: not allowed here");
  EXPECT_HAS(of_lens([](DecoySpec& s) { s.missing_panels = 1; }), "missing_panels: not allowed here");
  EXPECT_HAS(of_lens([](DecoySpec& s) { s.missing_panels = -1; }), "missing_panels: not allowed here");
  EXPECT_HAS(of_lens([](DecoySpec& s) { s.dented_panels = 1; }), "dented_panels: not allowed here");
  EXPECT_HAS(of_lens([](DecoySpec& s) { s.dent_depth = 0.1; }), "dent_depth: not allowed here");
  EXPECT_HAS(of_lens([](DecoySpec& s) { s.frame_mm = 10; }), "frame_mm: not allowed here");
  EXPECT_HAS(of_lens([](DecoySpec& s) { s.panel = DecoyPanel::kSquare; }), "panel: not allowed here");
  EXPECT_HAS(of_lens([](DecoySpec& s) { s.seam_errors_deg[0] = 1; }), "seam_errors_deg: not allowed here");
  for (const auto member : {&DecoySpec::cap_half_angle_deg, &DecoySpec::lens_loss_db})
    EXPECT_NE(of_lens([&](DecoySpec& s) { s.*member = nan; }), "accepted");
  for (const auto member : {&DecoySpec::angle_error_deg, &DecoySpec::surface_error_mm, &DecoySpec::rounding_mm,
                            &DecoySpec::dent_depth, &DecoySpec::frame_mm, &DecoySpec::mast_m, &DecoySpec::tether_m,
                            &DecoySpec::float_m, &DecoySpec::boresight_elevation_deg})
    EXPECT_NE(refusal([&](DecoySpec& s) { s.*member = nan; }), "accepted");
}

}  // namespace
}  // namespace seaglint

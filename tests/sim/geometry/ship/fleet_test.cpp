// SPDX-License-Identifier: BSD-3-Clause
// Generated ships: closed solids, hydrostatics against sections integrated by Simpson's rule, form coefficients and
// stability in the ranges of sim/geometry/ship/README.md.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/placement/hydrostatics.h"
#include "sim/geometry/ship/make_ship.h"
#include "sim/geometry/ship/ship_design.h"
#include "sim/scenario/material_spec.h"

namespace seaglint {
namespace {

constexpr std::uint64_t kSeeds = 50;

std::string name_of(ShipKind kind) { return kShipKindNames[static_cast<std::size_t>(kind)]; }

class Fleet : public testing::TestWithParam<ShipKind> {
 protected:
  // Calls with each of the kind's ships, the reference ship among them.
  template <typename Check>
  void for_each_ship(const Check& check) const {
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      SCOPED_TRACE(name_of(GetParam()) + ", seed " + std::to_string(seed));
      const ShipSpec spec{.kind = GetParam(), .seed = seed};
      check(spec, make_ship(spec));
      if (HasFailure()) return;
    }
  }
};

std::vector<ShipKind> kinds() {
  std::vector<ShipKind> all;
  for (std::size_t k = 0; k < std::size(kShipKindNames); ++k) all.push_back(static_cast<ShipKind>(k));
  return all;
}

INSTANTIATE_TEST_SUITE_P(Kinds, Fleet, testing::ValuesIn(kinds()),
                         [](const auto& kind) { return name_of(kind.param); });

// Triangles joined by edges: each closed solid of the mesh.
std::vector<std::vector<std::uint32_t>> solids_of(const TriangleMesh& mesh, const Topology& topology) {
  std::vector<bool> visited(mesh.triangles.size(), false);
  std::vector<std::vector<std::uint32_t>> solids;
  for (std::uint32_t start = 0; start < mesh.triangles.size(); ++start) {
    if (visited[start]) continue;
    std::vector<std::uint32_t> solid{start};
    visited[start] = true;
    for (std::size_t next = 0; next < solid.size(); ++next) {
      for (const std::uint32_t n : topology.neighbours[solid[next]]) {
        if (n == kNoIndex || visited[n]) continue;
        visited[n] = true;
        solid.push_back(n);
      }
    }
    solids.push_back(std::move(solid));
  }
  return solids;
}

TEST_P(Fleet, ConsistsOfClosedSolidsOfGenusZeroThatFaceOutwards) {
  for_each_ship([](const ShipSpec& spec, const Ship& ship) {
    const TriangleMesh& mesh = ship.mesh;
    const Topology topology = topology_of(mesh);
    EXPECT_TRUE(topology.degenerate.empty());
    EXPECT_EQ(topology.count(EdgeKind::kManifold), topology.edges.size());
    for (std::size_t p = 0; p < mesh.part_names.size(); ++p) EXPECT_TRUE(topology.part_closed[p]) << mesh.part_names[p];
    for (const auto& solid : solids_of(mesh, topology)) {
      const std::string& part = mesh.part_names[mesh.triangle_part[solid[0]]];
      double volume = 0;
      std::set<std::uint32_t> vertices;
      const Vec3 origin = mesh.vertices[mesh.triangles[solid[0]][0]];
      for (const std::uint32_t t : solid) {
        volume += (mesh.vertices[mesh.triangles[t][0]] - origin).dot(area_vector(mesh, t)) / 3;
        vertices.insert(mesh.triangles[t].begin(), mesh.triangles[t].end());
      }
      EXPECT_GT(volume, 0) << part;
      // Euler: V - E + F = 2, with E = 3 F / 2 of a closed surface.
      EXPECT_EQ(static_cast<long>(vertices.size()) - static_cast<long>(solid.size()) / 2, 2) << part;
    }
    if (spec.seed % 10 == 0) {
      EXPECT_THAT(diagnostic_messages(diagnose(mesh)), testing::IsEmpty());
    }
    for (const Vec3& p : mesh.vertices) ASSERT_LT(p.norm(), ship_reach_m(spec));
    EXPECT_GE(mesh.triangles.size(), 3000u);
    EXPECT_LE(mesh.triangles.size(), 60000u);
  });
}

TEST_P(Fleet, NamesMaterialsOfAssets) {
  for_each_ship([](const ShipSpec&, const Ship& ship) {
    for (const Material& material : ship.mesh.materials) {
      EXPECT_TRUE(material.name == "pec" || known_material(material.name, {})) << material.name;
    }
  });
}

// Boxes of solids that touch within 10 cm, from the hull on, are all: nothing hangs in the air. Nothing is outside of
// the deck's plan but boats, wings, fenders, tubes and rails.
TEST_P(Fleet, HasNoPartOutsideOfTheShip) {
  for_each_ship([](const ShipSpec&, const Ship& ship) {
    const TriangleMesh& mesh = ship.mesh;
    const Topology topology = topology_of(mesh);
    std::vector<Bounds> boxes;
    std::vector<std::string> parts;
    for (const auto& solid : solids_of(mesh, topology)) {
      Bounds box{Vec3::Constant(1e9), Vec3::Constant(-1e9)};
      for (const std::uint32_t t : solid) {
        for (const std::uint32_t v : mesh.triangles[t])
          box = {box.lower.cwiseMin(mesh.vertices[v]), box.upper.cwiseMax(mesh.vertices[v])};
      }
      boxes.push_back(box);
      parts.push_back(mesh.part_names[mesh.triangle_part[solid[0]]]);
    }
    ASSERT_EQ(parts[0], "hull");
    constexpr double kGap = 0.1;
    const auto touch = [&](const Bounds& a, const Bounds& b) {
      return (a.lower - b.upper).maxCoeff() <= kGap && (b.lower - a.upper).maxCoeff() <= kGap;
    };
    std::vector<bool> held(boxes.size(), false);
    std::vector<std::size_t> pending{0};
    held[0] = true;
    while (!pending.empty()) {
      const std::size_t from = pending.back();
      pending.pop_back();
      for (std::size_t other = 0; other < boxes.size(); ++other) {
        if (held[other] || !touch(boxes[from], boxes[other])) continue;
        held[other] = true;
        pending.push_back(other);
      }
    }
    const Bounds& hull = boxes[0];
    const double length = hull.upper.x() - hull.lower.x();
    for (std::size_t i = 1; i < boxes.size(); ++i) {
      EXPECT_TRUE(held[i]) << parts[i] << " touches nothing";
      EXPECT_GT(boxes[i].lower.x(),
                hull.lower.x() - 0.3 - 0.13 * (parts[i] == "tubes" || parts[i] == "engines") * length)
          << parts[i];
      EXPECT_LT(boxes[i].upper.x(), hull.upper.x() + 0.3 + 0.03 * length) << parts[i];
      EXPECT_LT(std::max(boxes[i].upper.y(), -boxes[i].lower.y()), hull.upper.y() + 1.5) << parts[i];
    }
  });
}

// Section of the body below z = 0 at x: area, its moments about z = 0 and y = 0, breadth and breadth^3 / 12 on the
// water. Cut triangle by triangle; each cut runs with the outside on its right.
struct Section {
  double area = 0, moment_z = 0, breadth = 0, breadth_cubed = 0;
};

Section section_of(const TriangleMesh& mesh, double x) {
  Section section;
  std::vector<double> crossings;  // of the waterline, y
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Vec3, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = mesh.vertices[mesh.triangles[t][i]];
    std::vector<Vec3> ends;
    for (int i = 0; i < 3; ++i) {
      const Vec3 &a = p[i], &b = p[(i + 1) % 3];
      if ((a.x() < x) == (b.x() < x)) continue;
      ends.push_back(a + (x - a.x()) / (b.x() - a.x()) * (b - a));
    }
    if (ends.size() != 2) continue;
    Vec3 from = ends[0], to = ends[1];
    if (from.z() >= 0 && to.z() >= 0) continue;
    // The waterline by what crosses a level 1 um below, since vertices may lie on the water itself.
    constexpr double kLevel = -1e-6;
    if ((from.z() > kLevel) != (to.z() > kLevel))
      crossings.push_back((from + (from.z() - kLevel) / (from.z() - to.z()) * (to - from)).y());
    if ((from.z() > 0) != (to.z() > 0))
      (from.z() > 0 ? from : to) = from + from.z() / (from.z() - to.z()) * (to - from);
    // The outward normal n of the section's outline: int z dy = sum of mean z times dy, signed by n_z.
    const double dy = std::abs(to.y() - from.y()), sign = area_vector(mesh, t).z() > 0 ? 1 : -1;
    section.area += sign * dy * 0.5 * (from.z() + to.z());
    section.moment_z += sign * dy * (from.z() * from.z() + from.z() * to.z() + to.z() * to.z()) / 6;
  }
  if (!crossings.empty()) {
    const auto [low, high] = std::ranges::minmax(crossings);
    section.breadth = high - low;
    section.breadth_cubed = section.breadth * section.breadth * section.breadth / 12;
  }
  return section;
}

TEST_P(Fleet, HasTheHydrostaticsOfItsSectionsBySimpsonsRule) {
  for_each_ship([](const ShipSpec&, const Ship& ship) {
    const Hydrostatics h = hydrostatics_of(ship.mesh);
    const TriangleMesh hull = part_of(ship.mesh, 0);
    const Bounds box = bounds(hull);
    constexpr int kIntervals = 400;
    double volume = 0, moment_x = 0, moment_z = 0, plane = 0, plane_x = 0, second = 0;
    const double step = (box.upper.x() - box.lower.x()) / kIntervals;
    for (int i = 0; i <= kIntervals; ++i) {
      const double weight = step / 3 * (i == 0 || i == kIntervals ? 1 : i % 2 == 1 ? 4 : 2);
      const double x = box.lower.x() + i * step;
      const Section section = section_of(hull, x);
      volume += weight * section.area;
      moment_x += weight * section.area * x;
      moment_z += weight * section.moment_z;
      plane += weight * section.breadth;
      plane_x += weight * section.breadth * x;
      second += weight * section.breadth_cubed;
    }
    EXPECT_NEAR(h.volume_m3 / volume, 1, 0.01);
    EXPECT_NEAR(h.waterplane_m2 / plane, 1, 0.01);
    EXPECT_NEAR(h.transverse_bm_m / (second / volume), 1, 0.01);
    EXPECT_NEAR(h.buoyancy_m.z() / (moment_z / volume), 1, 0.01);
    EXPECT_NEAR(h.buoyancy_m.x(), moment_x / volume, 0.01 * h.length_m);
    EXPECT_NEAR(h.flotation_x_m, plane_x / plane, 0.01 * h.length_m);
  });
}

// Ranges of sim/geometry/ship/README.md. KG is not drawn: it follows from GM and the mesh.
struct Form {
  double block_low, block_high;
  double gm_low, gm_high;  // GM over beam, over all loadings
  double kg_low, kg_high;  // KG over depth
};
const std::map<ShipKind, Form> kForms{
    {ShipKind::kFrigate, {0.48, 0.53, 0.065, 0.11, 0.55, 0.75}},
    {ShipKind::kCorvette, {0.45, 0.51, 0.07, 0.12, 0.55, 0.85}},
    {ShipKind::kPatrolBoat, {0.40, 0.45, 0.13, 0.20, 0.60, 0.95}},
    {ShipKind::kContainerShip, {0.60, 0.68, 0.02, 0.09, 0.50, 0.80}},
    {ShipKind::kTanker, {0.78, 0.84, 0.08, 0.24, 0.40, 0.67}},
    {ShipKind::kBulkCarrier, {0.79, 0.85, 0.07, 0.24, 0.40, 0.67}},
    {ShipKind::kFishingVessel, {0.50, 0.58, 0.07, 0.12, 0.55, 0.95}},
    {ShipKind::kFerry, {0.54, 0.61, 0.05, 0.10, 0.65, 1.0}},
    {ShipKind::kTug, {0.50, 0.58, 0.12, 0.20, 0.55, 0.95}},
    {ShipKind::kInflatableBoat, {0.36, 0.42, 0.36, 0.46, 0.5, 1.0}},
};

TEST_P(Fleet, HasFormAndStabilityOfItsKind) {
  const Form& form = kForms.at(GetParam());
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(name_of(GetParam()) + ", seed " + std::to_string(seed));
    const ShipSpec spec{.kind = GetParam(), .seed = seed};
    const Ship ship = make_ship(spec);
    Random random({seed, Stream::kShip, static_cast<std::uint64_t>(spec.kind)});
    const ShipDesign design = design_of(spec, random);
    const Hydrostatics h = hydrostatics_of(ship.mesh);
    const double gm = h.metacentric_height_m(ship.centre_of_gravity_m);
    EXPECT_GT(gm, form.gm_low * design.beam);
    EXPECT_LT(gm, form.gm_high * design.beam);
    EXPECT_NEAR(gm, design.metacentric_height, 1e-9 * design.beam);
    const double kg = ship.centre_of_gravity_m + design.draught;
    EXPECT_GT(kg / design.depth, form.kg_low);
    EXPECT_LT(kg / design.depth, form.kg_high);
    // The block coefficient of the laden ship on an even keel. Chords of plates are inside of the lines, 1.5 %; the
    // trim of 0.1 % deepens the draught by up to 1.5 %.
    ShipSpec laden = spec;
    laden.loading = 1;
    const Hydrostatics full = hydrostatics_of(make_ship(laden).mesh);
    EXPECT_GT(full.block_coefficient, form.block_low * 0.97);
    EXPECT_LT(full.block_coefficient, form.block_high);
  }
}

TEST(ShipOfASeed, IsTheSameEveryTimeAndAnotherForAnotherSeed) {
  for (const ShipKind kind : kinds()) {
    const Ship first = make_ship({.kind = kind, .seed = 7}), again = make_ship({.kind = kind, .seed = 7});
    EXPECT_EQ(first.mesh.vertices, again.mesh.vertices);
    EXPECT_EQ(first.mesh.triangles, again.mesh.triangles);
    EXPECT_NE(bounds(first.mesh).upper.x(), bounds(make_ship({.kind = kind, .seed = 8}).mesh).upper.x());
  }
}

TEST(ShipOfASeed, HasTheLengthThatIsAskedForAndRisesWhenUnloaded) {
  for (const ShipKind kind : kinds()) {
    const double length = kShipLengths_m[static_cast<std::size_t>(kind)].highest;
    const TriangleMesh hull = part_of(make_ship({.kind = kind, .length_m = length, .seed = 3}).mesh, 0);
    // A trim of 0.5 % shortens by 1e-5.
    EXPECT_NEAR(bounds(hull).upper.x() - bounds(hull).lower.x(), length, 2e-3 * length);
    const Hydrostatics light = hydrostatics_of(make_ship({.kind = kind, .loading = 0.0, .seed = 3}).mesh),
                       laden = hydrostatics_of(make_ship({.kind = kind, .loading = 1.0, .seed = 3}).mesh);
    EXPECT_LT(light.volume_m3, laden.volume_m3);
  }
}

TEST(ShipOfASeed, OfTheShortestLengthHasNoDefects) {
  for (const ShipKind kind : kinds()) {
    const double length = kShipLengths_m[static_cast<std::size_t>(kind)].lowest;
    EXPECT_THAT(diagnostic_messages(diagnose(make_ship({.kind = kind, .length_m = length}).mesh)), testing::IsEmpty())
        << name_of(kind);
  }
}

// The wheelhouse of a boat below 20 m is no higher than a person needs and wider than half the boat.
TEST(ShipOfASeed, OfTheShortestFishingVesselsHasAWheelhouseOfOneStorey) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const TriangleMesh mesh = make_ship({.kind = ShipKind::kFishingVessel, .length_m = 12, .seed = seed}).mesh;
    const auto part = std::ranges::find(mesh.part_names, "wheelhouse") - mesh.part_names.begin();
    Bounds box{Vec3::Constant(1e9), Vec3::Constant(-1e9)};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (mesh.triangle_part[t] != part) continue;
      for (const std::uint32_t v : mesh.triangles[t])
        box = {box.lower.cwiseMin(mesh.vertices[v]), box.upper.cwiseMax(mesh.vertices[v])};
    }
    const Vec3 size = box.upper - box.lower, ship = bounds(mesh).upper - bounds(mesh).lower;
    EXPECT_GT(size.y(), 1.8);
    EXPECT_LT(size.z(), 2.7);
    EXPECT_GT(size.y(), 0.5 * ship.y());
    EXPECT_THAT(mesh.part_names, testing::Not(testing::Contains("accommodation")));
  }
}

TEST(ShipOfASeed, OutOfTheRangeOfItsKindIsRefusedWithTheKindsThatHaveIt) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(make_ship({.kind = ShipKind::kTug, .length_m = nan}), InputError);
  EXPECT_THROW(make_ship({.kind = ShipKind::kTug, .length_m = -30}), InputError);
  EXPECT_THROW(make_ship({.kind = ShipKind::kTug, .loading = 1.1}), InputError);
  EXPECT_THROW(make_ship({.kind = ShipKind::kTug, .loading = nan}), InputError);
  try {
    make_ship({.kind = ShipKind::kContainerShip, .length_m = 8});
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "length_m: value 8: must be within 110 and 400 for a container_ship; kinds of that length: "
                 "inflatable_boat");
  }
}

// A box floats at half its depth: every figure in closed form.
TEST(Hydrostatics, OfABoxAreItsClosedForms) {
  MeshBuilder builder;
  builder.begin_part("box");
  const double l = 20, b = 6, t = 2, rise = 3, x0 = 1.5;
  std::vector<std::uint32_t> v;
  for (const double z : {-t, rise}) {
    for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
      v.push_back(builder.vertex({x0 + x * l, y * b, z}));
  }
  builder.quad(v[3], v[2], v[1], v[0]);
  builder.quad(v[4], v[5], v[6], v[7]);
  for (std::uint32_t i = 0; i < 4; ++i) builder.quad(v[i], v[(i + 1) % 4], v[4 + (i + 1) % 4], v[4 + i]);
  const Hydrostatics h = hydrostatics_of(builder.take());
  EXPECT_NEAR(h.volume_m3, l * b * t, 1e-9);
  EXPECT_NEAR(h.waterplane_m2, l * b, 1e-9);
  EXPECT_NEAR(h.wetted_m2, l * b + 2 * (l + b) * t, 1e-9);
  EXPECT_NEAR(h.flotation_x_m, x0, 1e-12);
  EXPECT_NEAR((h.buoyancy_m - Vec3(x0, 0, -0.5 * t)).norm(), 0, 1e-12);
  EXPECT_NEAR(h.transverse_bm_m, b * b / (12 * t), 1e-12);
  EXPECT_NEAR(h.longitudinal_bm_m, l * l / (12 * t), 1e-11);
  EXPECT_NEAR(h.block_coefficient, 1, 1e-12);
  EXPECT_NEAR(h.metacentric_height_m(0.5), b * b / (12 * t) - 0.5 * t - 0.5, 1e-12);
}

TEST(Hydrostatics, OfABodyAboveTheWaterAreZero) {
  EXPECT_EQ(hydrostatics_of(make_combatant(ShipDetail::kHull)).volume_m3, 0);
}

}  // namespace
}  // namespace seaglint

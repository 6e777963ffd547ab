// SPDX-License-Identifier: BSD-3-Clause
// The hierarchy of panels against Embree, and against a test of every panel.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sim/core/numbers/random.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/scatterer/embree_scene.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// All panels that overlap a prism of the given width about a ray.
std::vector<int> walked(const Scatterer& scatterer, const Ray& ray, double width) {
  const RadarBasis across = radar_basis(ray.direction);
  const double x = across.h.dot(ray.origin), y = across.v.dot(ray.origin);
  const Prism prism{{across.h, across.v}, {x - width / 2, y - width / 2}, {x + width / 2, y + width / 2},
                    ray.direction,        ray.direction.dot(ray.origin),  ray.direction,
                    Vec3::Zero()};
  std::vector<int> found;
  scatterer.tree().traverse(prism, [&](const BvhPanel& panel) {
    found.push_back(panel.facet);
    return std::numeric_limits<double>::infinity();
  });
  std::sort(found.begin(), found.end());
  return found;
}

Ray random_ray(Random& random, double radius) {
  const Vec3 direction = Vec3(random.normal(), random.normal(), random.normal()).normalized();
  return {radius * Vec3(random.uniform() - 0.5, 0.2 * (random.uniform() - 0.5), 0.2 * random.uniform()), direction};
}

TEST(PanelBvh, FindsThePanelsThatARayHits) {
  const Scatterer ship(read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb"));
  const RayScene scene(ship.facets());
  Random random({23, Stream::kTest, 0});
  int hits = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Ray ray = random_ray(random, ship.radius());
    int hit = kNoFacet;
    scene.first_hits({&ray, 1}, {&hit, 1});
    if (hit == kNoFacet) continue;
    ++hits;
    // Embree's coordinates are single precision: 6e-8 of 72 m.
    const auto found = walked(ship, ray, 1e-4);
    EXPECT_TRUE(std::binary_search(found.begin(), found.end(), ship.panels().representative(hit))) << trial;
  }
  EXPECT_GT(hits, 5000);
}

TEST(PanelBvh, FindsEveryPanelWithAVertexInThePrism) {
  const Scatterer reflector(make_icosahedral_reflector());
  Random random({23, Stream::kTest, 1});
  for (int trial = 0; trial < 2000; ++trial) {
    const Ray ray = random_ray(random, reflector.radius());
    const RadarBasis across = radar_basis(ray.direction);
    const auto found = walked(reflector, ray, 0.2);
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end()) << "a facet twice";
    for (int f = 0; f < static_cast<int>(reflector.facets().size()); ++f) {
      for (const Vec3& corner : reflector.facets()[f].corner) {
        const Vec3 from = corner - ray.origin;
        if (std::abs(across.h.dot(from)) < 0.1 && std::abs(across.v.dot(from)) < 0.1 && ray.direction.dot(from) > 0) {
          EXPECT_TRUE(std::binary_search(found.begin(), found.end(), reflector.panels().representative(f))) << trial;
        }
      }
    }
  }
}

// Seen along the diagonal a cube is a hexagon: the corners of its bounding rectangle are empty.
TEST(PanelBvh, ExcludesAPrismNextToASkewedBox) {
  TriangleMesh mesh = make_plate(1, 1);
  mesh.vertices = {{0, 0, 0}, {1, 1, 0}, {0, 1, 1}};  // their box is the unit cube
  mesh.triangles = {{0, 1, 2}};
  mesh.triangle_part = mesh.triangle_material = {0};
  const Scatterer triangle(mesh);
  const Vec3 along = Vec3(1, 1, 1).normalized();
  const RadarBasis across = radar_basis(along);
  const auto walked_at = [&](double h, double v) {
    const Vec3 centre = 0.5 * Vec3(1, 1, 1) - triangle.centre();
    return !walked(triangle, {centre + h * across.h + v * across.v - 5 * along, along}, 0.02).empty();
  };
  // Vertices at 0.816 from its middle, sides at 0.707, two of them normal to h.
  for (const double h : {-0.6, 0.6}) {
    for (const double v : {-0.7, 0.7}) EXPECT_FALSE(walked_at(h, v)) << h << ' ' << v;
  }
  for (const auto& [h, v] : {std::pair{0.0, 0.8}, {0.0, -0.8}, {0.68, 0.4}, {-0.68, -0.4}, {0.68, 0.0}})
    EXPECT_TRUE(walked_at(h, v)) << h << ' ' << v;
}

TEST(PanelBvh, IsFiniteForManyPanelsAtOnePlace) {
  // A hundred copies of one plate: no cut separates their centres, and the hierarchy must still be finite.
  TriangleMesh mesh = make_plate(0.3, 0.2);
  for (int i = 0; i < 99; ++i) mesh.append(make_plate(0.3, 0.2));
  const Scatterer plates(mesh);
  // many facets have each edge in common: none are joined
  EXPECT_EQ(walked(plates, {Vec3::UnitX(), -Vec3::UnitX()}, 0.01).size(), 200u);
}

}  // namespace
}  // namespace seaglint

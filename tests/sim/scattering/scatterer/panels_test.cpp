// SPDX-License-Identifier: BSD-3-Clause
// Panels, their sharp edges, and the searches among them: hierarchy and Embree.
#include "sim/scattering/scatterer/panels.h"

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/surface/facets.h"
#include "sim/scattering/scatterer/embree_scene.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Panels: facets of one plane joined to convex polygons.

double area_of(std::span<const Vec3> outline, const Vec3& normal) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
    twice += (outline[i] - outline[0]).cross(outline[i + 1] - outline[0]).dot(normal);
  return twice / 2;
}

TEST(Panels, JoinTheTwoTrianglesOfAPlate) {
  const auto facets = make_facets(make_plate(0.3, 0.2));
  const Panels panels(facets);
  ASSERT_EQ(panels.outline(0).size(), 4u);
  EXPECT_TRUE(panels.outline(1).empty());
  EXPECT_EQ(panels.representative(1), 0);
  EXPECT_EQ(panels.members(0).size(), 2u);
  EXPECT_NEAR(panels.size(0), std::hypot(0.3, 0.2), 1e-15);
}

TEST(Panels, OfTheShipAreConvexLieInOnePlaneAndKeepItsArea) {
  const auto facets = make_facets(read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb"));
  const Panels panels(facets);
  std::vector<int> memberships(facets.size(), 0);
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    if (!panels.is_representative(f)) continue;
    const auto outline = panels.outline(f);
    double area = 0;
    for (const int member : panels.members(f)) {
      ++memberships[member];
      EXPECT_EQ(panels.representative(member), f);
      EXPECT_EQ(facets[member].part, facets[f].part);
      area += area_of(facets[member].corner, facets[f].normal);
      for (const Vec3& x : facets[member].corner) EXPECT_LT(std::abs(facets[f].normal.dot(x) - facets[f].offset), 1e-7);
    }
    EXPECT_NEAR(area_of(outline, facets[f].normal), area, 1e-10 * area + 1e-12);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec3 &a = outline[i], &b = outline[(i + 1) % outline.size()], &c = outline[(i + 2) % outline.size()];
      EXPECT_GT((b - a).cross(c - b).dot(facets[f].normal), 0) << f;
    }
  }
  EXPECT_EQ(std::count(memberships.begin(), memberships.end(), 1), static_cast<std::ptrdiff_t>(facets.size()))
      << "every facet in one panel";
}

TEST(Panels, AreSeparateWhereMaterialOrPlaneChanges) {
  TriangleMesh mesh = make_plate(0.3, 0.2);
  auto facets = make_facets(mesh);
  facets[1].material = 1;
  EXPECT_TRUE(Panels(facets).is_representative(1));
  mesh.vertices[mesh.triangles[1][1]].x() += 1e-5;
  mesh.vertices[mesh.triangles[1][2]].x() += 1e-5;
  mesh.vertices[mesh.triangles[0][0]].x() -= 1e-5;
  EXPECT_EQ(Panels(make_facets(mesh)).outline(0).size(), 3u);
}

// Which edges are sharp, and which of their faces records the illumination.

TEST(SharpEdges, AreThoseOfAPlateABoxAndADihedral) {
  const auto edges_of = [](const TriangleMesh& mesh) { return Scatterer(mesh).edges().edges; };
  const auto free_edges = edges_of(make_plate(0.3, 0.2));
  EXPECT_EQ(free_edges.size(), 4u);
  for (const SharpEdge& edge : free_edges) EXPECT_DOUBLE_EQ(edge.front_wedge.N, 2);
  // Seen from within the dihedral the seam is concave; from behind it is a wedge of three right angles.
  int seams = 0;
  for (const SharpEdge& edge : edges_of(make_dihedral(0.25, 0.3, kPi / 2))) {
    if (edge.is_free_edge()) continue;
    ++seams;
    EXPECT_NEAR(std::min(edge.front_wedge.N, edge.back_wedge.N), 0.5, 1e-12);
    EXPECT_NEAR(std::max(edge.front_wedge.N, edge.back_wedge.N), 1.5, 1e-12);
  }
  EXPECT_EQ(seams, 1);
  EXPECT_TRUE(edges_of(make_sphere(1, 3)).empty());
}

// The collinear length of an edge does not depend on triangulation and position; it ends at a vertex of the face.
TEST(SharpEdges, HaveTheLengthOfTheirCollinearChain) {
  const Mat3 rotation = axis_rotation(0.7, Vec3(1, 2, 3).normalized());
  for (const std::uint32_t pieces : {1u, 16u}) {
    const Scatterer plate(transformed(cut_plate(0.3, 0.2, pieces), rotation, Vec3(40, -7, 3)), {}, 0.0);
    EXPECT_EQ(plate.edges().edges.size(), 4 * pieces);
    const Vec3 wide = rotation * Vec3::UnitY();
    for (const SharpEdge& edge : plate.edges().edges) {
      const double expected = std::abs(edge.along().dot(wide)) > 0.5 ? 0.3 : 0.2;
      EXPECT_NEAR(edge.collinear_length_m, expected, 1e-13 * pieces);  // of positions 40 m out
    }
  }
}

// At a vertex of a hundred loose triangles no edge continues in the opposite one.
TEST(SharpEdges, EndTheirRunsInAFanOfLooseTriangles) {
  constexpr std::uint32_t kTriangles = 100;
  TriangleMesh fan = make_plate(1, 1);
  fan.vertices = {Vec3::Zero()};
  fan.triangles.clear();
  for (std::uint32_t i = 0; i < kTriangles; ++i) {
    const double start = 2 * kPi * i / kTriangles, end = 2 * kPi * (i + 0.5) / kTriangles;
    fan.vertices.push_back({std::cos(start), std::sin(start), 0});
    fan.vertices.push_back({std::cos(end), std::sin(end), 0});
    fan.triangles.push_back({0, 2 * i + 1, 2 * i + 2});
  }
  fan.triangle_part.assign(kTriangles, 0);
  fan.triangle_material.assign(kTriangles, 0);
  const Scatterer scatterer(fan);
  EXPECT_EQ(scatterer.edges().edges.size(), 3 * kTriangles);
  for (const SharpEdge& edge : scatterer.edges().edges) EXPECT_EQ(edge.collinear_length_m, edge.length());
}

// Concave edges: those that image theory solves exactly do not diffract, nor do those with more images than the sum
// contains.
TEST(SharpEdges, ConcaveOnesDiffractBetween12And180Deg) {
  const auto corner_diffracts = [](double opening_deg) {
    const Scatterer scatterer(make_dihedral(0.25, 0.3, radians(opening_deg)));
    for (const SharpEdge& edge : scatterer.edges().edges) {
      if (edge.is_free_edge()) continue;
      const WedgeFrame& corner = edge.front_wedge.N < 1 ? edge.front_wedge : edge.back_wedge;
      const Vec3 between = (corner.face[0].x + corner.face[1].x).normalized();
      const WedgeFrame* wedge = illuminated_wedge(edge, -between);
      EXPECT_TRUE(wedge == nullptr || wedge == &corner) << opening_deg;
      return wedge != nullptr;
    }
    ADD_FAILURE() << "no seam";
    return false;
  };
  for (const double opening_deg : {150.0, 100.0, 50.0, 13.0}) EXPECT_TRUE(corner_diffracts(opening_deg)) << opening_deg;
  for (const double opening_deg : {90.0, 60.0, 45.0, 11.0, 3.0})
    EXPECT_FALSE(corner_diffracts(opening_deg)) << opening_deg;
}

// A wave incident between the faces of a concave edge of sheets illuminates the concave edge. After reflection by one
// face it illuminates the other one up to the seam and seems to arrive from behind the first, where the edge is a
// convex wedge; it excites neither, since its echo is part of the concave edge's. A wave that does arrive from behind
// excites the convex wedge via the face that it illuminates.
TEST(SharpEdges, ConcaveOnesAreNotIlluminatedByTheirOwnFaces) {
  for (const double opening_deg : {90.0, 135.0, 150.0}) {
    const Scatterer scatterer(make_dihedral(0.25, 0.3, radians(opening_deg)));
    for (const SharpEdge& edge : scatterer.edges().edges) {
      if (edge.is_free_edge()) continue;
      const bool concave_outside = edge.front_wedge.N < 1;
      const WedgeFrame &corner = concave_outside ? edge.front_wedge : edge.back_wedge,
                       &back = concave_outside ? edge.back_wedge : edge.front_wedge;
      // the reflected direction; beyond twice that angle no reflected wave reaches the other face
      const double above = 0.5 * (kPi - radians(opening_deg));
      for (const int reflecting_face : {0, 1}) {
        const WedgeFace& face = corner.face[reflecting_face];
        const Vec3 reflected = -std::cos(above) * face.x + std::sin(above) * face.n;
        EXPECT_EQ(illuminated_wedge(edge, reflected), &back) << opening_deg;
        EXPECT_EQ(wedge_on_illuminated_face(edge, reflecting_face == 1, reflected), nullptr) << opening_deg;
        EXPECT_EQ(wedge_on_illuminated_face(edge, reflecting_face == 0, reflected), &back) << opening_deg;
        EXPECT_FALSE(records_edge(edge, back, reflecting_face == 1, reflected)) << opening_deg;
      }
    }
  }
}

TEST(SharpEdges, ExactlyOneFaceRecordsEachEdge) {
  const TriangleMesh ship = read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb");
  for (const TriangleMesh& mesh : {ship, make_square_trihedral(0.4)}) {
    const Scatterer scatterer(mesh);
    const SharpEdges& edges = scatterer.edges();
    Random random({3, Stream::kTest, 18});
    for (int i = 0; i < 20; ++i) {
      const Vec3 k_hat = Vec3(random.normal(), random.normal(), random.normal()).normalized();
      std::vector<int> records(edges.edges.size(), 0);
      for (int panel = 0; panel < static_cast<int>(scatterer.facets().size()); ++panel) {
        for (const PanelEdge& side : edges.edges_of_panel(panel)) {
          const SharpEdge& edge = edges.edges[side.edge];
          const WedgeFrame* wedge = side.may_record_edge(k_hat) ? illuminated_wedge(edge, k_hat) : nullptr;
          const bool recorded_here = wedge && records_edge(edge, *wedge, side.is_first_face, k_hat);
          records[side.edge] += recorded_here;
          if (recorded_here) {
            EXPECT_EQ(wedge_on_illuminated_face(edge, side.is_first_face, k_hat), wedge) << side.edge;
          }
        }
      }
      for (std::size_t number = 0; number < edges.edges.size(); ++number) {
        const SharpEdge& edge = edges.edges[number];
        // The free edge of a sheet has one panel, which records it once.
        if (illuminated_wedge(edge, k_hat)) {
          EXPECT_EQ(records[number], 1) << number;
        }
        if (!edge.two_sided && edge.front_wedge.N < 1 && std::abs(std::sin(kPi / edge.front_wedge.N)) < 1e-3) {
          EXPECT_EQ(records[number], 0) << number;
        }
      }
    }
  }
}

// The hierarchy of panels against Embree, and against a test of every panel.

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
  for (const double h : {-0.6, 0.6})
    for (const double v : {-0.7, 0.7}) EXPECT_FALSE(walked_at(h, v)) << h << ' ' << v;
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

TEST(RayScene, KeepsTheCallersFloatingPointMode) {
  const RayScene plate(make_facets(make_plate(1, 1)));
  const std::vector<Ray> rays(20, Ray{Vec3(1, 0.1, 0.2), Vec3(-1, 0, 0)});
  std::vector<int> hits(rays.size(), kNoFacet);
  for (const unsigned flush : {unsigned{_MM_FLUSH_ZERO_OFF}, unsigned{_MM_FLUSH_ZERO_ON}}) {
    const unsigned before = _mm_getcsr();
    _MM_SET_FLUSH_ZERO_MODE(flush);
    const unsigned set = _mm_getcsr();
    plate.first_hits(rays, hits);
    const unsigned after = _mm_getcsr();
    _mm_setcsr(before);
    constexpr unsigned kModes = ~unsigned{_MM_EXCEPT_MASK};  // the mode without the flags of exceptions that occurred
    EXPECT_EQ(after & kModes, set & kModes);
    for (const int hit : hits) EXPECT_EQ(hit, hits.front());
    EXPECT_NE(hits.front(), kNoFacet);
  }
}

TEST(RayScene, NamesTheTriangleThatEmbreeWouldOmit) {
  std::vector<Facet> facets = make_facets(make_plate(1, 1));
  facets[1].corner[2].x() = 2e18;
  try {
    const RayScene scene(facets);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "Embree takes no triangle 1 of 2: a corner lies beyond 1e18 m");
  }
}

// Every box is a leaf once, and lies in all boxes above it.
TEST(BvhBuild, ContainsEveryBoxOnceWithinItsParents) {
  Random random({29, Stream::kTest, 0});
  for (const int count : {1, 2, 5, 1000}) {
    std::vector<Box3> boxes(count);
    for (Box3& box : boxes) {
      const Vec3 x(random.normal(), random.normal(), random.normal());
      box.add(x);
      // Some without extent, and many identical ones.
      box.add(random.uniform() < 0.5 ? x : Vec3(x + Vec3(random.uniform(), 0, random.uniform())));
      if (random.uniform() < 0.3) box = boxes[0];
    }
    const std::vector<BvhNode> nodes = build_bvh(boxes);
    std::vector<int> visits(count, 0);
    int deepest = 0;
    const auto visit = [&](const auto& self, const BvhNode& node, int level) -> void {
      deepest = std::max(deepest, level);
      for (int i = 0; i < node.children; ++i) {
        const BvhNode::Child& child = node.child[i];
        if (child.index >= 0) {
          for (int k = 0; k < nodes[child.index].children; ++k) {
            for (int a = 0; a < 3; ++a) {
              EXPECT_LE(child.lower[a], nodes[child.index].child[k].lower[a]);
              EXPECT_GE(child.upper[a], nodes[child.index].child[k].upper[a]);
            }
          }
          self(self, nodes[child.index], level + 1);
        } else {
          ++visits[-1 - child.index];
          for (int a = 0; a < 3; ++a) {
            EXPECT_LE(child.lower[a], boxes[-1 - child.index].lower[a]);
            EXPECT_GE(child.upper[a], boxes[-1 - child.index].upper[a]);
          }
        }
      }
    };
    visit(visit, nodes.at(0), 1);
    for (const int times : visits) EXPECT_EQ(times, 1);
    EXPECT_LE(deepest, kMaxLevels);
  }
  EXPECT_TRUE(build_bvh({}).empty());
}

}  // namespace
}  // namespace seaglint

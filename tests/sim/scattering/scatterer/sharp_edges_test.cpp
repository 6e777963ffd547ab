// SPDX-License-Identifier: BSD-3-Clause
// Which edges are sharp, and which of their faces records the illumination.
#include "sim/scattering/scatterer/panels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using testing_echoes::cut_plate;

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

}  // namespace
}  // namespace seaglint

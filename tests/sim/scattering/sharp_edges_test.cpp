// SPDX-License-Identifier: BSD-3-Clause
// Which edges are sharp, and which of their faces speaks for them.
#include "sim/scattering/edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/core/random.h"
#include "sim/geometry/generators.h"
#include "sim/geometry/mesh_io.h"
#include "sim/scattering/scatterer.h"

namespace seaglint {
namespace {

TEST(SharpEdges, AreThoseOfAPlateABoxAndADihedral) {
  const auto edges_of = [](const TriangleMesh& mesh) { return Scatterer(mesh).edges().edges; };
  const auto rims = edges_of(make_plate(0.3, 0.2));
  EXPECT_EQ(rims.size(), 4u);
  for (const SharpEdge& edge : rims) EXPECT_DOUBLE_EQ(edge.outside.N, 2);
  // Seen from within the corner the seam is concave; from behind it is a wedge of three right angles.
  int seams = 0;
  for (const SharpEdge& edge : edges_of(make_dihedral(0.25, 0.3, kPi / 2))) {
    if (edge.facet[0] == edge.facet[1]) continue;
    ++seams;
    EXPECT_NEAR(std::min(edge.outside.N, edge.inside.N), 0.5, 1e-12);
    EXPECT_NEAR(std::max(edge.outside.N, edge.inside.N), 1.5, 1e-12);
  }
  EXPECT_EQ(seams, 1);
  EXPECT_TRUE(edges_of(make_sphere(1, 3)).empty());
}

TEST(SharpEdges, OfEveryWedgeThatDiffractsOneSideSpeaks) {
  const TriangleMesh ship = read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb");
  for (const TriangleMesh& mesh : {ship, make_square_trihedral(0.4)}) {
    const Scatterer scatterer(mesh);
    const SharpEdges& edges = scatterer.edges();
    Random random({3, Stream::kTest, 18});
    for (int i = 0; i < 20; ++i) {
      const Vec3 k_hat = Vec3(random.normal(), random.normal(), random.normal()).normalized();
      std::vector<int> speaking(edges.edges.size(), 0);
      for (int panel = 0; panel < static_cast<int>(scatterer.facets().size()); ++panel) {
        for (const PanelEdge& side : edges.of_panel(panel)) speaking[side.edge] += side.speaks(k_hat);
      }
      for (std::size_t number = 0; number < edges.edges.size(); ++number) {
        const SharpEdge& edge = edges.edges[number];
        // The rim of a sheet has one facet, which keeps it once.
        if (wedge_towards(edge, k_hat)) {
          EXPECT_EQ(speaking[number], 1) << number;
        }
        if (!edge.open && edge.outside.N < 1 && std::abs(std::sin(kPi / edge.outside.N)) < 1e-3) {
          EXPECT_EQ(speaking[number], 0) << number;
        }
      }
    }
  }
}

}  // namespace
}  // namespace seaglint

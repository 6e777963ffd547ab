// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What is wrong with a mesh, counted, and the part of it that can be put right without guessing.

#include <string>
#include <vector>

#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Surfaces are triangles that hang together along edges of two. One is closed when every edge is run through as often
// in either direction: it is judged by itself, though it may touch others along edges of four and more. Those that end
// at such edges hang together there too.
struct MeshDiagnostics {
  std::size_t triangles = 0;
  std::size_t degenerate = 0;          // without area
  std::size_t repeated = 0;            // further copies of a triangle, facing the same way
  std::size_t two_sided = 0;           // further copies facing the other way: the backs of sheets without thickness
  std::size_t kept_backs = 0;          // backs of another material: these stay
  std::size_t dropped_backs = 0;       // backs of another material that are left out, since their surface is open
  std::string lost_part, lost_behind;  // part of the first of those, and of its front
  // The rest as it is without those.
  std::size_t open_edges = 0;          // of one triangle: holes, rims of sheets
  std::size_t non_manifold_edges = 0;  // of three and more
  std::size_t inconsistent_edges = 0;  // whose two triangles face opposite ways
  std::size_t surfaces = 0;
  std::size_t open_surfaces = 0;
  std::size_t non_manifold_surfaces = 0;  // of them without open or mixed edges: three or five triangles meet somewhere
  std::size_t inverted_surfaces = 0;      // closed and enclosing a negative volume: inside out
  std::size_t inverted_triangles = 0;     // of those surfaces
};

// Vertices are one when their index is: weld first (read_mesh does).
MeshDiagnostics diagnose(const TriangleMesh& mesh);

// One sentence for each finding, with what the solver makes of it; empty for a sound closed mesh.
std::vector<std::string> diagnostic_messages(const MeshDiagnostics& health);

// Without degenerate triangles and copies, and with closed surfaces turned outwards. Of coinciding triangles a ray
// meets only one, of a surface inside out a solver that leaves out what faces away sees the inside. The back of a sheet
// stays where its material is another and the sheet closed with it, so materials are chosen first. A closed cavity
// within a closed body is turned too, which nobody sees. Everything else stays, in its order.
TriangleMesh repair(const TriangleMesh& mesh);

}  // namespace seaglint

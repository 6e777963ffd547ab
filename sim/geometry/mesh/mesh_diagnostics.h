// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Defects of a mesh, counted, and the repair of those that have a unique repair.

#include <string>
#include <vector>

#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// A surface is a set of triangles connected across edges of exactly two triangles. It is closed when its triangles
// traverse every edge equally often in both directions; it is tested separately even where it touches other surfaces
// along edges of four or more triangles. Surfaces that are not closed by this test are joined across such edges and
// tested again.
struct MeshDiagnostics {
  std::size_t triangles = 0;
  std::size_t degenerate = 0;          // zero area
  std::size_t repeated = 0;            // further copies of a triangle with the same orientation
  std::size_t two_sided = 0;           // further copies with opposite orientation: backs of sheets without thickness
  std::size_t covered = 0;             // backs of sheets that are cut otherwise than the fronts
  double covered_m2 = 0;               // their area
  std::size_t partly = 0, unlike = 0;  // that overlap others in part; of another material, in open surfaces
  double partly_m2 = 0, unlike_m2 = 0;
  bool is_crowded = false;             // CoincidingFaces::is_crowded
  std::size_t kept_backs = 0;          // backs of another material that are kept
  std::size_t dropped_backs = 0;       // backs of another material that are removed, because their surface is open
  std::string lost_part, lost_behind;  // part of the first removed back, and of its front
  // Counts after the removal of degenerate triangles and copies.
  std::size_t open_edges = 0;          // of one triangle: holes, free edges of sheets
  std::size_t non_manifold_edges = 0;  // of three or more triangles
  std::size_t inconsistent_edges = 0;  // whose two triangles have opposite orientation
  std::size_t surfaces = 0;
  std::size_t open_surfaces = 0;
  std::size_t non_manifold_surfaces =
      0;  // open surfaces without open or inconsistent edges: three or five triangles meet at an edge
  std::size_t inverted_surfaces = 0;       // closed, with negative enclosed volume: inside out
  std::size_t inverted_triangles = 0;      // of those surfaces
  std::size_t corners_without_normal = 0;  // of a mesh that has normals
  std::vector<std::string> of_file{};      // TriangleMesh::findings
  Vec3 size = Vec3::Zero();                // of the bounding box, m
};

// Vertices are identified by their index: weld first (read_mesh does).
MeshDiagnostics diagnose(const TriangleMesh& mesh);

// One sentence per defect, with its treatment by the solver; empty for a closed mesh without defects.
std::vector<std::string> diagnostic_messages(const MeshDiagnostics& health);

// The mesh without degenerate triangles, copies and covered backs of sheets (coinciding_faces.h), with closed surfaces
// oriented outwards, their normals too; triangles keep their order. A ray meets only one of coinciding triangles, and
// the solver skips facets that face away, so that of an inside-out surface it would illuminate the inside. The back of
// a sheet is kept where its material differs and its surface is closed, so materials are assigned before the repair. A
// closed cavity inside a closed body is also oriented outwards; it is never visible.
TriangleMesh repair(const TriangleMesh& mesh);

struct RepairedMesh {
  TriangleMesh mesh;
  MeshDiagnostics health;  // before the repair
};

// Both at once, in the time of one.
RepairedMesh diagnose_and_repair(const TriangleMesh& mesh);

}  // namespace seaglint

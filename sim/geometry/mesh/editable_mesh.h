// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Triangles whose planar faces can be triangulated anew: removal of vertices by half-edge collapse and edge flips.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

class EditableMesh {
 public:
  // `face`: planar face of every triangle, numbers below the count of triangles. Vertices at one position must be one
  // vertex.
  EditableMesh(const TriangleMesh& mesh, std::vector<std::uint32_t> face);

  // The vertices of this triangle will not be removed.
  void keep_vertices(std::uint32_t triangle);

  // Removes vertices inside a face and vertices where exactly two collinear boundary edges of faces meet. A removed
  // vertex lies within `tolerance` (m) of the boundary edge that replaces its edges (H. Hoppe et al., Proc. SIGGRAPH
  // 1993, 19-26: edge collapse and its link condition).
  void remove_flat_vertices(double tolerance);

  // Flips edges inside faces until they are Delaunay triangulations constrained by the faces' boundaries (C. L. Lawson,
  // in Mathematical Software III, 1977, 161-194); ties as in merge_planar_faces().
  void make_delaunay();

  // Replaces the triangles of the mesh, with parts, materials and the corner normals of unchanged triangles, and
  // numbers the faces from 0.
  void store(TriangleMesh& mesh, std::vector<std::uint32_t>& face) const;

 private:
  using Triangle = std::array<std::uint32_t, 3>;
  using Edge = std::pair<std::uint32_t, std::uint32_t>;  // ascending

  bool is_alive(std::uint32_t t) const { return triangles_[t][0] != triangles_[t][1]; }
  std::vector<std::uint32_t> triangles_at(std::uint32_t a, std::uint32_t b) const;
  // The two triangles of an edge; none where it has one or more than two.
  std::optional<std::array<std::uint32_t, 2>> two_triangles_at(std::uint32_t a, std::uint32_t b) const;
  // Vertices joined to v, ascending.
  std::vector<std::uint32_t> neighbours(std::uint32_t v) const;
  // True unless exactly two triangles of one face and of opposite sense share the edge.
  bool is_boundary(std::uint32_t a, std::uint32_t b) const;
  // True where triangles that are alone in their face at v have more than two edges there: all are boundaries.
  bool is_corner(std::uint32_t v) const;
  bool remove_vertex(std::uint32_t v, double tolerance);
  // Moves v to u, where no other triangle turns over or loses its area and the surface keeps its topology.
  bool collapse(std::uint32_t v, std::uint32_t u);
  bool is_before(std::uint32_t a, std::uint32_t b) const;
  bool flip_if_needed(std::uint32_t a, std::uint32_t b, std::vector<Edge>& around);

  std::vector<Vec3> vertices_;
  std::vector<Triangle> triangles_;  // removed ones have equal vertices
  std::vector<std::uint32_t> face_;
  std::vector<std::vector<std::uint32_t>> at_;  // triangles by vertex
  std::map<Edge, std::vector<Vec3>> removed_;   // vertices removed from boundary edges
  std::vector<char> kept_;                      // by vertex
  std::vector<Vec3> face_normal_;               // by triangle number of the face, unit
};

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Planar faces of a mesh, independent of how they were triangulated; flat facets of a target with planes and
// neighbours, in double precision, and normals of the surface that facets approximate.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

struct PlanarFaces {
  TriangleMesh mesh;                // vertices at identical positions merged
  std::vector<std::uint32_t> face;  // planar face of every triangle, numbered in order of their first triangle
};

// The same surface with every planar face triangulated anew. A face consists of neighbouring triangles of one part and
// material within `tolerance` (m) of the plane of the largest exactly planar region among them. Vertices inside a face
// and on straight parts of its boundary, free and non-manifold edges included, are removed; the others stay where they
// are. The triangulation is the constrained Delaunay triangulation of each face; of cocircular vertices the one with
// the smallest coordinates is joined to all others. Meshes that differ in the division of their planar faces only give
// the same triangles. Triangles with corner normals off their own stay as they are.
PlanarFaces merge_planar_faces(const TriangleMesh& mesh, double tolerance);

struct Facet {
  std::array<Vec3, 3> corner;
  Vec3 normal = Vec3::UnitZ();  // unit, right-handed with the corners
  double offset = 0;            // plane: normal . x = offset
  double longest_edge = 0;      // m
  // Facet across the side corner[i] -> corner[i+1]; -1 at a free edge; the next one of the ring where more than two
  // facets share the side.
  std::array<std::int32_t, 3> neighbour{-1, -1, -1};
  bool two_sided = false;      // part of a surface with a free edge: visible from either side
  std::uint16_t part = 0;      // index of mesh.part_names
  std::uint16_t material = 0;  // index of mesh.materials
  std::int32_t face = -1;      // planar face, PlanarFaces::face; -1: of no known face
  // Normals of the smooth surface at the corners, unit, as its file gives them; zero: none.
  std::array<Vec3, 3> corner_normal{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
};

// Facets of the mesh without its degenerate triangles (height below 1e-9 m). Neighbours are found by vertex position,
// so that duplicated vertices do not separate facets.
// face: planar face of every triangle, or empty.
std::vector<Facet> make_facets(const TriangleMesh& mesh, std::span<const std::uint32_t> face = {});

// Index of the facet's corner at this position, or -1.
int corner_at(const Facet& facet, const Vec3& position);

// Weight of a triangle in the normal of one of its vertices, from its sides a and b there (m). Triangles of similar
// width: sin(angle) / (product of both sides), exact on a sphere for any triangulation (N. Max, Journal of Graphics
// Tools 4, 1999, 1-6). Others: angle times width (m), which keeps a large flat face beside the narrow strips of a
// fillet flat to within their sagitta. Neither depends on the triangulation of a flat face.
double corner_weight(const Vec3& a, const Vec3& b, double width, bool alike);

// Corner normals of the surface that continues across every edge of two triangles whose normals differ by at most
// crease_rad (0 <= x <= pi): the weighted mean over the fan of triangles so connected at a vertex by
// corner_weight(), of similar width within a factor of 2. Zero where the fan is flat: one triangle, or the surface
// rises over none of its triangles by more than negligible_m, the deviation of the normal times the longest side / 8.
// Vertices are identified by position.
std::vector<std::array<Vec3, 3>> crease_normals(const TriangleMesh& mesh, double crease_rad, double negligible_m = 0);

// Gives the corners without a normal that of their triangle, as in a file, where all have one; a mesh without any
// normal is left as it is.
void fill_normals(TriangleMesh& mesh);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Normals of a surface from the facets that approximate it.

#include <array>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

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

}  // namespace seaglint

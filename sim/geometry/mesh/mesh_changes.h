// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Other meshes of the same surface: cut, numbered or rounded differently, with noise on the vertices. Parts,
// materials and corner normals are kept.

#include "sim/core/numbers/random.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Every triangle cut into four at the midpoints of its sides, which are rounded to float32 on request. The normal at a
// midpoint is the mean of those at both ends.
TriangleMesh cut_in_four(const TriangleMesh& mesh, bool as_float = false);

// Vertices and triangles in random order, triangles starting at a random corner.
TriangleMesh renumbered(const TriangleMesh& mesh, Random& random);

// Vertices displaced by a normal distribution of this standard deviation in every coordinate, m.
TriangleMesh with_noise(const TriangleMesh& mesh, double sigma, Random& random);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Canonical targets with known radar cross-sections. Every size is in metres, kMinSize <= x <= kLargestSize, else
// InputError.

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Limits that every format of mesh_io.h preserves: beyond 1e7 m a mesh is rejected; coordinates below 1e-30 m are read
// as zero, also those of a finely subdivided target.
inline constexpr double kMinSize = 1e-20, kLargestSize = 1e7;

// A flat sheet of two triangles in the plane x = 0, centred on the origin, `length` along y and `width` along z, normal
// +x: azimuth 0, elevation 0 is normal incidence. One sheet, both sides of which scatter.
TriangleMesh make_plate(double length, double width);

// Two sheets `width` wide that meet in a seam of `length` along z through the origin, open towards +x with `opening`
// (radians, 0 < x < pi) between them: azimuth 0, elevation 0 is the bisector. Normals point into the opening.
TriangleMesh make_dihedral(double length, double width, double opening);

// Three right triangles (or squares) in the planes x = 0, y = 0, z = 0 with legs of `leg` along +x, +y, +z, apex at the
// origin; normals point into the first octant. Boresight is azimuth 45 deg, elevation 35.2644 deg.
TriangleMesh make_triangular_trihedral(double leg);
TriangleMesh make_square_trihedral(double leg);

// Icosahedron whose 20 faces are split `subdivisions` times into four (0..8, 20 * 4^n triangles), vertices on the
// sphere about the origin.
TriangleMesh make_sphere(double radius, int subdivisions);

// Capped prism of `segments` sides (3..100000) about the z axis, centred on the origin, its vertices on the cylinder.
TriangleMesh make_cylinder(double radius, double height, int segments);

// Right-angled trihedron sunk into each of the 20 faces of a regular icosahedron of edge s: 60 right isosceles
// triangles, a closed surface about the origin, leg s/sqrt2, circumradius 0.9511 s. The parts cell_01..cell_20 are the
// trihedra; cell_01 faces +x at rest, and of its opening the vertex in the plane y = 0 is the upper one. s = 0.526 m is
// about 1 m across.
inline constexpr double kReflectorEdge = 0.526;
TriangleMesh make_icosahedral_reflector(double edge = kReflectorEdge);

}  // namespace seaglint

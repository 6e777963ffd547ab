// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Canonical targets with known radar cross-sections, and closed solids of which larger targets are made. Lengths are in
// metres.

#include <vector>

#include "sim/core/numbers/rotation.h"
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

// Closed solids with outward faces, added to a mesh under construction; the elements of the generated ship.

// Box with its base centred on the pose's origin: |x| <= size.x/2, |y| <= size.y/2, 0 <= z <= size.z.
void add_box(MeshBuilder& builder, const Pose& pose, const Vec3& size);

// Frustum between two convex polygons of equal vertex count, counter-clockwise seen from above, the upper above the
// lower.
void add_frustum(MeshBuilder& builder, const std::vector<Vec3>& lower, const std::vector<Vec3>& upper);

// Capped cone or cylinder of `sides` faces from one point to another.
void add_cone(MeshBuilder& builder, const Vec3& from, const Vec3& to, double radius_from, double radius_to, int sides);

// Prism of square cross-section about the axis between two points; unless the axis is vertical, one side face is turned
// upwards.
void add_bar(MeshBuilder& builder, const Vec3& from, const Vec3& to, double width);

// Plate of the given convex outline (counter-clockwise about the normal), `thickness` thick, with the outline on the
// front.
void add_plate(MeshBuilder& builder, const std::vector<Vec3>& outline, double thickness);

// Box of `size` as in add_box whose face at +x is open: walls `wall` thick around a hollow with eight inner
// right-angled trihedral corners.
void add_open_box(MeshBuilder& builder, const Pose& pose, const Vec3& size, double wall);

// Three plates that meet at right angles at the origin of the pose, with lengths `legs` along its axes +x, +y, +z.
void add_corner_plates(MeshBuilder& builder, const Pose& pose, const Vec3& legs, double thickness);

// Sphere of 80 triangles (or 320) about a point.
void add_sphere(MeshBuilder& builder, const Vec3& centre, double radius, int subdivisions);

}  // namespace seaglint

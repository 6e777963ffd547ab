// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Closed solids with outward faces, added to a mesh under construction; the elements of the generated ship. Lengths in
// metres.

#include <vector>

#include "sim/core/numbers/pose.h"
#include "sim/geometry/mesh/mesh_builder.h"

namespace seaglint {

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

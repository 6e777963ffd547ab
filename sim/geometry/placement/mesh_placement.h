// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A mesh file as the mesh of a body: its unit, which of its axes point forward and up, its size and its place.

#include <filesystem>
#include <string>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// Rotation from the axes of a file to the body frame of CONVENTIONS.md: forward becomes +x, up +z and up x forward +y.
// Throws InputError for words that are none of kMeshAxes and for axes that are not perpendicular to each other.
Mat3 rotation_of(const MeshPlacement& placement);

// p -> scale R p + offset, of a mesh in metres: turned first, then enlarged about the origin of the file, then moved.
// Its normals are turned. The unit is not used.
TriangleMesh placed(TriangleMesh mesh, const MeshPlacement& placement);

// The file in `placement.unit`, placed(). Throws InputError as read_mesh() and rotation_of() do, and for a mesh that is
// placed beyond 1e7 m.
TriangleMesh read_placed_mesh(const std::filesystem::path& path, const MeshPlacement& placement);

// "unit mm forward +y up +z scale 2 offset_m 0,0,1.5": the unit, and what differs from its default.
std::string placement_text(const MeshPlacement& placement);

// The placement of a body of another scale, enlarged about the origin of the body frame, so that its waterline stays at
// z = 0: the offset is in proportion.
MeshPlacement with_scale(MeshPlacement placement, double scale);

}  // namespace seaglint

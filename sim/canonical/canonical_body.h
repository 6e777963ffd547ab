// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Bodies whose echo is known in closed form, recognised from their mesh: sphere, rectangular plate, dihedral and
// trihedral corner reflectors.

#include <optional>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

enum class CanonicalShape { kSphere, kPlate, kDihedral, kTriangularTrihedral, kSquareTrihedral };

struct CanonicalBody {
  CanonicalShape shape = CanonicalShape::kSphere;
  // Sphere: its centre. Plate: its centre. Dihedral: the middle of its seam. Trihedral: its apex. m, body frame.
  Vec3 centre_m = Vec3::Zero();
  // Sphere: its radius. Plate: its sides. Dihedral: depth of a face, length of the seam. Trihedral: its leg. m.
  double a_m = 0, b_m = 0;
  // Columns, unit vectors. Plate: along a, along b, normal. Dihedral: from the seam into each face, along the seam.
  // Trihedral: along its legs, from the apex.
  Mat3 axes = Mat3::Identity();
};

// "sphere of radius 0.3 m", "triangular trihedral of legs 0.5 m".
std::string text_of(const CanonicalBody& body);

// The body that a mesh in metres samples; absent for any other mesh. Faces meet at 90 +- 0.1 deg, sides and legs that
// are equal agree within 2e-3, facets cover their face once within 4e-3 of its area. The vertices of a sphere lie
// within 2e-3 of its radius, its facets are closed and have 0.97 of its area at least.
std::optional<CanonicalBody> canonical_body(const TriangleMesh& mesh);

// The body of canonical_body(), or the spheres that all connected components of the mesh sample; empty for others.
std::vector<CanonicalBody> canonical_bodies(const TriangleMesh& mesh);

}  // namespace seaglint

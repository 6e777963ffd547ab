// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Which part of a target is made of what.

#include <span>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scenario/material_spec.h"

namespace seaglint {

struct PartMaterial {
  std::string part;  // name of a part; with a * at the end, all parts whose names begin so
  MaterialSpec material;
};

// Gives every triangle a material: `all`, or the last of `parts` that names its part. Sets mesh.materials and
// triangle_material, whatever the file said, and returns the specifications in the order of mesh.materials. Throws
// InputError for a part that the mesh does not have.
std::vector<MaterialSpec> assign_materials(TriangleMesh& mesh, const MaterialSpec& all,
                                           std::span<const PartMaterial> parts);

// Cuts the mesh at z = height; what lies below hides what is behind it but neither reflects nor radiates. `materials`
// are those of mesh.materials and get one more.
void cut_at_sea_level(TriangleMesh& mesh, std::vector<MaterialSpec>& materials, double height);

// Throws InputError when a frequency lies outside the range a material's source covers.
void check_frequencies(std::span<const MaterialSpec> materials, double lowest_hz, double highest_hz);

}  // namespace seaglint

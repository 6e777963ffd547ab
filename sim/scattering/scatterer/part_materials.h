// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Materials of the parts of a target, and the cut at the sea level.

#include <span>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scenario/material_spec.h"

namespace seaglint {

struct PartMaterial {
  std::string part;  // name of a part, else of a material of the mesh's file; with a trailing *, all with that prefix
  MaterialSpec material;
};

// Assigns a material to every triangle: `all`, or the last entry of `parts` that matches it. Overwrites
// mesh.materials and triangle_material and returns the specifications in the order of mesh.materials. Throws InputError
// for a name that neither parts nor materials of the mesh have.
std::vector<MaterialSpec> assign_materials(TriangleMesh& mesh, const MaterialSpec& all,
                                           std::span<const PartMaterial> parts);

// Cuts the mesh at z = height, m. Triangles below become a submerged material, appended to mesh.materials and
// `materials`: they occlude but neither reflect nor radiate.
void cut_at_sea_level(TriangleMesh& mesh, std::vector<MaterialSpec>& materials, double height);

// Throws InputError when a material's source does not cover lowest_hz to highest_hz.
void check_frequencies(std::span<const MaterialSpec> materials, double lowest_hz, double highest_hz);

}  // namespace seaglint

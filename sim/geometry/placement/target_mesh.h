// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Mesh of a target from its file: placed by its unit, by the axes that point forward and up, by its size and its place;
// with the materials of its parts, repaired and checked.

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scenario/material_spec.h"
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

// Material of the whole target (no part), of one part, or with a trailing * of every part whose name has that prefix,
// * alone of every face. The last choice that matches a part applies.
struct MaterialChoice {
  std::optional<std::string> part;
  std::string material = "pec";  // name in assets/materials, or a file
  std::string place;             // source of the choice, prefix of error messages
};

// Mesh file, or a mesh, with the materials of its surfaces. Faces that no choice matches have the material of
// assets/materials that is named as their material in the mesh, others are perfect conductors.
struct TargetSource {
  std::filesystem::path mesh;
  MeshPlacement placement;
  std::shared_ptr<const TriangleMesh> loaded;  // in metres, in place of the file and its unit; may be null
  std::vector<MaterialChoice> materials;       // of users; one of the whole target leaves none to the mesh
  std::filesystem::path material_folder;       // folder searched first for material files
  double lowest_hz = 1e9, highest_hz = 1e9;
  // Prefixes of error messages about materials, their frequencies and the mesh; empty: none.
  std::string materials_place, frequencies_place, mesh_place;
  std::string all_conductor;  // what a user writes for a perfect conductor throughout, in messages
};

// Mesh in the form the solver requires, with its materials.
struct TargetMesh {
  TriangleMesh mesh;
  std::vector<MaterialSpec> materials;  // in the order of mesh.materials
  std::vector<std::string> warnings;    // one sentence per defect or possible mistake of the mesh
  std::string materials_note;           // which materials are the mesh's; empty: none
};

// Reads the mesh, assigns its materials and repairs it. Throws InputError for a mesh that is missing, invalid or
// entirely degenerate, for what check_target() refuses, and for a material that is missing, invalid or not defined at
// the frequencies.
TargetMesh load_target_mesh(const TargetSource& source);

struct PartMaterial {
  // Name of a part, else of a material of the mesh's file; with a trailing *, all with that prefix; *: every face.
  std::string part;
  MaterialSpec material;
};

// Assigns a material to every triangle: `all`, or the last entry of `parts` that matches it. Overwrites
// mesh.materials and triangle_material and returns the specifications in the order of mesh.materials. Throws InputError
// for a name that neither parts nor materials of the mesh have.
std::vector<MaterialSpec> assign_materials(TriangleMesh& mesh, const MaterialSpec& all,
                                           std::span<const PartMaterial> parts);

// Gives the faces that still have materials[0] the known material (known_material()) that is named as their material in
// `before`: materials and triangle_material of the mesh before assign_materials(). Appends these to mesh.materials and
// `materials`, and returns their names. folder: searched first for material files. Throws InputError for an invalid
// file.
std::vector<std::string> assign_own_materials(TriangleMesh& mesh, std::vector<MaterialSpec>& materials,
                                              const TriangleMesh& before, const std::filesystem::path& folder);

// Cuts the mesh at z = height, m. Triangles below become a submerged material, appended to mesh.materials and
// `materials`: they occlude but neither reflect nor radiate.
void cut_at_sea_level(TriangleMesh& mesh, std::vector<MaterialSpec>& materials, double height);

// Throws InputError when a material's source does not cover lowest_hz to highest_hz.
void check_frequencies(std::span<const MaterialSpec> materials, double lowest_hz, double highest_hz);

// One sentence per warning; empty for most targets. lowest_hz: lowest frequency of the sweep. Throws InputError when
// the target is more than 300 half-sizes from its origin, so that its details are smaller than the smallest patch kept.
std::vector<std::string> check_target(const TriangleMesh& mesh, double lowest_hz);

}  // namespace seaglint

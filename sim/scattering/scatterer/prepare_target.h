// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Preparation of a target from its mesh file: read, assign materials, repair, check, cut at the waterline.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/placement/waterline.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scenario/material_spec.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// Material of the whole target (no part), of one part, or with a trailing * of every part whose name has that prefix.
// The last choice that matches a part applies.
struct MaterialChoice {
  std::optional<std::string> part;
  std::string material = "pec";  // name in assets/materials, or a file
  std::string place;             // source of the choice, prefix of error messages
};

// Mesh file, or a mesh, with the materials of its surfaces.
struct TargetSource {
  std::filesystem::path mesh;
  MeshPlacement placement;
  std::shared_ptr<const TriangleMesh> loaded;  // in metres, in place of the file and its unit; may be null
  std::vector<MaterialChoice> materials;       // empty: perfect conductor
  std::filesystem::path material_folder;       // folder searched first for material files
  double lowest_hz = 1e9, highest_hz = 1e9;
  // Prefixes of error messages about materials, their frequencies and the mesh; empty: none.
  std::string materials_place, frequencies_place, mesh_place;
};

// Mesh in the form the solver requires, with its materials.
struct SolverMesh {
  TriangleMesh mesh;
  std::vector<MaterialSpec> materials;  // in the order of mesh.materials
  std::vector<std::string> warnings;    // one sentence per defect or possible mistake of the mesh
};

// Reads the mesh, assigns its materials and repairs it. Throws InputError for a mesh that is missing, invalid or
// entirely degenerate, for what check_target() refuses, and for a material that is missing, invalid or not defined at
// the frequencies.
SolverMesh load_solver_mesh(const TargetSource& source);

struct ScattererSettings {
  std::optional<double> waterline_m;  // z of the mean sea surface in the mesh frame, m; absent: no sea
  // Whether the sea reflects (four paths). The submerged part then remains: it occludes, but neither reflects nor
  // radiates, and the waterline does not diffract. Otherwise it is removed (above_water()).
  bool sea_reflects = false;
  std::optional<double> crease_rad;  // crease angle of Scatterer; absent: as the mesh's normals or its shape say
  double sheet_thickness_m = 0;      // thickness of open surfaces
  bool edges = true;                 // edge diffraction is used
  double lowest_hz = 1e9, highest_hz = 1e9;  // the highest determines which facets are merged (merging_tolerance())
};

// Target ready for illumination.
struct PreparedTarget {
  TriangleMesh mesh;  // without the triangles below the waterline or, where the sea reflects, with these submerged
  std::vector<MaterialSpec> materials;
  SubmergedPart below;                // what is below the waterline
  std::vector<std::string> warnings;  // warnings about mesh and edges
  std::shared_ptr<const Scatterer> scatterer;
};

// Cuts the mesh at the waterline, builds the scatterer and checks its edges and bars (target_check.h).
PreparedTarget prepare_target(SolverMesh mesh, const ScattererSettings& settings);

}  // namespace seaglint

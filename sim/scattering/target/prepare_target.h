// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A target between its mesh file and the solver: read, given its materials, repaired, checked, cut at the water.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/target/scatterer.h"
#include "sim/scenario/material_spec.h"

namespace seaglint {

// The material of the whole target (no part), of the part of this name, or with a * at its end of all parts whose names
// begin so. The last choice that names a part holds.
struct MaterialChoice {
  std::optional<std::string> part;
  std::string material = "pec";  // a name of assets/materials or a file
  std::string place;             // where it was chosen, as error messages begin
};

// A mesh file and what its surfaces are made of.
struct TargetSource {
  std::filesystem::path mesh;
  std::string unit = "m";
  std::vector<MaterialChoice> materials;  // none: all is perfect conductor
  std::filesystem::path material_folder;  // where files of materials are looked for first
  double lowest_hz = 1e9, highest_hz = 1e9;
  // How error messages about the choice of materials, their frequencies and the mesh begin; empty: as they are.
  std::string materials_place, frequencies_place, mesh_place;
};

// A mesh as the solver takes it.
struct SolverMesh {
  TriangleMesh mesh;
  std::vector<MaterialSpec> materials;  // of mesh.materials
  std::vector<std::string> doubts;      // a sentence for everything that was wrong with the file's mesh or may be
};

// Reads the mesh, assigns its materials and repairs it. Throws InputError for a mesh that is missing, unsound or
// without a triangle that has an area, for what check_target() refuses, and for a material that is missing, unsound or
// not known at the frequencies.
SolverMesh load_solver_mesh(const TargetSource& source);

struct ScattererSettings {
  std::optional<double> waterline_m;               // z of the mean water surface in the mesh's frame; absent: no sea
  double crease_rad = radians(kDefaultCreaseDeg);  // facets that turn by less belong to one smooth surface
  double sheet_thickness_m = 0;                    // of open surfaces
  bool edges = true;                               // sharp edges are to scatter
  double lowest_hz = 1e9, highest_hz = 1e9;
};

// A target ready to be illuminated.
struct PreparedTarget {
  TriangleMesh mesh;  // what lies below the waterline is of kSubmerged
  std::vector<MaterialSpec> materials;
  std::vector<std::string> doubts;  // about mesh and edges
  std::shared_ptr<const Scatterer> scatterer;
};

// Cuts the mesh at the waterline, builds the scatterer and checks its edges.
PreparedTarget prepare_target(SolverMesh mesh, const ScattererSettings& settings);

}  // namespace seaglint

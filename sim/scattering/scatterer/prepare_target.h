// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Preparation of a target from its mesh file: read, assign materials, repair, check, cut at the waterline.

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/placement/waterline.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scenario/material_spec.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// Materials of the parts of a target, and the cut at the sea level.

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

// Checks of a target against the validity of the solver: electrical size, position, number of triangles, edges and
// bars.

// One sentence per warning; empty for most targets. lowest_hz: lowest frequency of the sweep. Throws InputError when
// the target is more than 300 half-sizes from its origin, so that its details are smaller than the smallest patch kept.
std::vector<std::string> check_target(const TriangleMesh& mesh, double lowest_hz);

// One sentence where sharp edges longer than a wavelength bound bars or strips narrower than a third of it on both
// sides: their half-plane currents neglect each other and return too much. One sentence where sheets are thicker than a
// tenth of the shortest wavelength, or where a thickness has no effect: no sheets, or edges not used (`followed`). One
// sentence where edges of materials longer than a wavelength do not diffract. Sentences name the part with the greatest
// length of such edges.
std::vector<std::string> check_edges(const Scatterer& scatterer, bool followed, double lowest_hz, double highest_hz,
                                     std::span<const std::string> part_names = {});

// One sentence, with the part that has the greatest length of them, where surfaces longer than a wavelength are round
// bars thinner than 0.7 of it. Backscatter of the circular cylinder by physical optics less the exact series, normal
// incidence, largest of both polarisations at diameters of 0.1, 0.2, 0.33, 0.5, 0.7 and 1 wavelengths: 7.0, 2.6,
// 0.6, 2.9, 0.4, 0.6 dB.
std::vector<std::string> check_bars(const Scatterer& scatterer, double lowest_hz,
                                    std::span<const std::string> part_names = {});

// Preparation of a target from its mesh file: read, assign materials, repair, check, cut at the waterline.

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

// Cuts the mesh at the waterline, builds the scatterer and checks its edges and bars (check_edges(), check_bars()).
PreparedTarget prepare_target(SolverMesh mesh, const ScattererSettings& settings);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scatterer of a target in the sea or above it, with warnings where it exceeds the validity of the solver.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/geometry/placement/target_mesh.h"
#include "sim/geometry/placement/waterline.h"
#include "sim/scattering/scatterer/scatterer.h"

namespace seaglint {

struct ScattererSettings {
  std::optional<double> waterline_m;  // z of the mean sea surface in the mesh frame, m; absent: no sea
  // Whether the sea reflects (four paths). The submerged part then remains: it occludes, but neither reflects nor
  // radiates, and the waterline does not diffract. Otherwise it is removed (above_water()).
  bool sea_reflects = false;
  std::optional<double> crease_rad;  // crease angle of Scatterer; absent: as the mesh's normals or its shape say
  double sheet_thickness_m = 0;      // thickness of open surfaces
  bool edges = true;                 // edge diffraction is used
  double lowest_hz = 1e9, highest_hz = 1e9;  // the highest determines which facets are merged (merging_tolerance())

  bool operator==(const ScattererSettings&) const = default;
};

// Target ready for illumination.
struct PreparedTarget {
  TriangleMesh mesh;  // without the triangles below the waterline or, where the sea reflects, with these submerged
  std::vector<MaterialSpec> materials;
  SubmergedPart below;                // what is below the waterline
  std::vector<std::string> warnings;  // warnings about mesh and edges
  std::string materials_note;         // of TargetMesh
  std::shared_ptr<const Scatterer> scatterer;
};

// Cuts the mesh at the waterline, builds the scatterer and checks its edges and bars (check_edges(), check_bars()).
PreparedTarget prepare_target(TargetMesh mesh, const ScattererSettings& settings);

// Warnings about edges, at most one sentence of each kind, with the part that has the greatest length of such edges:
// bars and strips narrower than a third of the longest wavelength on both sides of an edge longer than it, whose
// half-plane currents neglect each other and return too much; sheets thicker than a tenth of the shortest wavelength; a
// thickness without effect, without sheets or edge diffraction (`followed`); edges of materials, longer than a
// wavelength, that do not diffract.
std::vector<std::string> check_edges(const Scatterer& scatterer, bool followed, double lowest_hz, double highest_hz,
                                     std::span<const std::string> part_names = {});

// A warning, with the part that has the greatest length of them, where surfaces longer than a wavelength are round bars
// thinner than 0.7 of it. Backscatter of the circular cylinder by physical optics less the exact series, normal
// incidence, largest of both polarisations at diameters of 0.1, 0.2, 0.33, 0.5, 0.7 and 1 wavelengths: 7.0, 2.6, 0.6,
// 2.9, 0.4, 0.6 dB.
std::vector<std::string> check_bars(const Scatterer& scatterer, double lowest_hz,
                                    std::span<const std::string> part_names = {});

}  // namespace seaglint

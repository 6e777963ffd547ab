// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Request for a sweep of scattering matrices, as plain values.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/cavity/cavity_scattering.h"
#include "sim/field_tables/transmitter_keys.h"
#include "sim/scattering/scatterer/prepare_target.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "sim/scenario/sea_spec.h"
#include "sim/scenario/target_spec.h"
#include "tools/rcs/rcs_sweep.h"

namespace seaglint {

// The sea under a target at rest.
struct SeaUnderTarget {
  bool reflection = false;
  double height_m = 0;       // of the mesh's origin above the mean surface
  double wave_height_m = 0;  // significant
  SeaSurface surface = SeaSurface::kSeaWater;
  SeaPaths paths = SeaPaths::kAll;
};

// Parts of the mesh that are walls of open cavities, solved by the magnetic-field integral equation.
struct CavityRequest {
  std::vector<std::string> parts;
  double patches_per_wavelength = kPatchesPerWavelength;
};

// Contributions that are summed, KIND=VALUE each: part=NAME, bounces=N, mechanism=po|edge.
struct EchoSelection {
  std::vector<std::string> only;     // alternatives within a kind; kinds are combined by AND
  std::vector<std::string> without;  // excluded
};

// Exports of the contributions at one aspect and frequency; an empty file name means none.
struct ViewExport {
  std::string centres, hot_spots;
  double cell_m = 0.1;   // side of the cells whose contributions are merged into one scattering centre
  double range_db = 60;  // dynamic range below the strongest

  bool wanted() const { return !centres.empty() || !hot_spots.empty(); }
};

struct RcsRequest : MeshPlacement {
  std::filesystem::path target;              // mesh file
  std::shared_ptr<const TriangleMesh> mesh;  // in metres, in place of the file and its unit; may be null
  std::vector<MaterialChoice> materials;     // empty: perfect conductor throughout
  std::vector<double> frequency_hz, azimuth_deg, elevation_deg{0};
  std::optional<FixedTransmitter> transmitter;  // bistatic: the sweep is over the receiver's directions
  double range_m = 0;                           // 0: far field
  bool edges = true;                            // fringe currents at sharp edges
  bool uncertainty = false;                     // also computes the echo of flat facets
  bool physical_optics_too = false;             // also computes a second model without edge diffraction
  int max_bounces = kDefaultBounces;
  SolverMethod method = SolverMethod::kBeams;
  double min_patch_m = 0;            // 0: min_patch()
  double ray_spacing_m = 0;          // of method rays; 0: ray_spacing()
  std::optional<double> crease_deg;  // absent: as the mesh's normals or its shape say
  double sheet_thickness_mm = 0;
  std::string like;  // program whose settings were taken (like_program.h); empty: none
  EchoSelection selection;
  SeaUnderTarget sea;
  CavityRequest cavities;
  ViewExport exports;
};

// Method of this name, one of kSolverMethodNames. Throws InputError for another name.
SolverMethod solver_method_of(std::string_view name);

// Sweep of the request's directions and frequencies, without models. Throws InputError for a contradictory request and
// for more than four million rows.
RcsSweep requested_sweep(const RcsRequest& request);

// Warnings about the request, a sentence each, to be shown before the work.
std::vector<std::string> request_warnings(const RcsRequest& request);

}  // namespace seaglint

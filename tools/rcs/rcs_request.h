// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a computation of scattering matrices is asked for, as plain values.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/cavity/cavity_scattering.h"
#include "sim/scattering/beams/illumination_settings.h"
#include "sim/scattering/target/prepare_target.h"
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

// Parts of the mesh whose echo is found from the field inside them.
struct CavityRequest {
  std::vector<std::string> parts;
  double patches_per_wavelength = kPatchesPerWavelength;
};

// Which echoes are summed, KIND=VALUE each: part=NAME, bounces=N, mechanism=po|edge.
struct EchoSelection {
  std::vector<std::string> only;     // of one kind any, of several kinds all must hold
  std::vector<std::string> without;  // none of these
};

// Files that show what one view at one frequency consists of; an empty name asks for none.
struct ViewExport {
  std::string centres, hot_spots;
  double cell_m = 0.1;   // of the cells whose contributions become one centre
  double range_db = 60;  // weakest below the strongest

  bool wanted() const { return !centres.empty() || !hot_spots.empty(); }
};

struct FixedTransmitter {
  double azimuth_deg = 0, elevation_deg = 0;
};

struct RcsRequest {
  std::filesystem::path target;           // mesh file
  std::string unit = "m";                 // of the mesh: m, cm, mm, km, in, ft
  std::vector<MaterialChoice> materials;  // none: all is perfect conductor
  std::vector<double> frequency_hz, azimuth_deg, elevation_deg{0};
  std::optional<FixedTransmitter> transmitter;  // bistatic: the sweep is then the receiver's
  double range_m = 0;                           // 0: far field
  bool edges = true;                            // fringe currents at sharp edges
  bool physical_optics_too = false;             // a second model without them
  int max_bounces = kDefaultBounces;
  double ray_spacing_m = 0;  // 0: 0.001 radius
  double crease_deg = kDefaultCreaseDeg, sheet_thickness_mm = 0;
  EchoSelection selection;
  SeaUnderTarget sea;
  CavityRequest cavities;
  ViewExport exports;
};

// Directions and frequencies of the request without a model. Throws InputError for what contradicts itself and for more
// than four million rows.
RcsSweep requested_sweep(const RcsRequest& request);

// What a user should know before the work begins, a sentence each.
std::vector<std::string> doubts_of(const RcsRequest& request);

}  // namespace seaglint

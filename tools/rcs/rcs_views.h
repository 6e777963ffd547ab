// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What `seaglint rcs` is asked for, and how it fills its sweep.

#include <optional>
#include <string>
#include <vector>

#include "sim/scattering/response/illumination.h"
#include "sim/scattering/target/smooth_surface.h"
#include "tools/cli/cavity_arguments.h"
#include "tools/cli/command.h"
#include "tools/cli/reference_arguments.h"
#include "tools/cli/sea_arguments.h"
#include "tools/rcs/rcs_sweep.h"
#include "tools/rcs/view_export.h"

namespace seaglint {

struct RcsArguments {
  std::string target, unit = "m", frequency_ghz, azimuth_deg, elevation_deg = "0", edges = "on", output;
  double ray_spacing_m = 0, range_m = 0;
  std::optional<double> transmit_azimuth_deg, transmit_elevation_deg;  // bistatic: the sweep is then the receiver's
  double crease_deg = kDefaultCreaseDeg, sheet_thickness_mm = 0;
  int max_bounces = kDefaultBounces;
  ReferenceArguments reference;
  ViewExportArguments view;
  std::vector<std::string> materials;  // NAME or PART=NAME
  SeaArguments sea;
  CavityArguments cavities;
};

// Of the view the sweep's own antenna: the receiver's where the transmitter stands still.
RadarBasis basis_of(const RcsSweep& sweep, std::size_t view);

// Fills the sweep's models, one view after the other; returns the legs of beams followed. Throws WorkError when it is
// interrupted.
std::size_t trace_views(const RcsArguments& arguments, const Scatterer& scatterer, const EchoFilter& filter,
                        const Shell& shell, RcsSweep& sweep);

// Adds the echoes of cavities to every model of the sweep. Throws WorkError when one has no answer or it is
// interrupted.
void add_cavities(const RcsArguments& arguments, const std::vector<NamedCavity>& cavities, const EchoFilter& filter,
                  const Shell& shell, RcsSweep& sweep);

// On standard error, when receivers stand where the target hides the transmitter.
void warn_of_receivers_behind(const RcsSweep& sweep);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Settings of one illumination: depth of the beams, edge diffraction, and the smallest patches kept.

#include "sim/scattering/beams/contribution_filter.h"
#include "sim/scattering/target/scatterer.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

struct TracingSettings {
  // Side of the smallest illuminated patch kept, m; beams narrower than 3.6 times it are not followed to further
  // reflectors. 0 or coarser than default_min_patch(): that.
  double min_patch_m = 0;
  int max_bounces = kDefaultBounces;  // 1 <= x <= kMaxBounces
  bool edges = false;                 // edge diffraction
  ContributionFilter filter = {};     // contributions that are summed; beams end at the walls of cavities only
};

// Side of the smallest illuminated patch kept by default, m: 0.7e-4 of the radius, 5 mm on the 144 m ship.
double default_min_patch(const Scatterer& scatterer);

// Side of the smallest illuminated patch kept, m: that of the settings, or the default where that is finer.
double min_patch(const Scatterer& scatterer, const TracingSettings& settings);

// A tenth of the amplitude k area / 2 pi of the smallest patch, m: end-point and edge contributions below it may be
// left out. On the ship they are -65 dB of the echo together.
double min_amplitude(const Scatterer& scatterer, const TracingSettings& settings, double k);

// Area of the smallest illuminated patch kept, m^2.
double smallest_area(const Scatterer& scatterer, const TracingSettings& settings);

}  // namespace seaglint

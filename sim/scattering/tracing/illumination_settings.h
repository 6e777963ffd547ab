// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Settings of one illumination: depth of the beams, edge diffraction, and the smallest patches kept.

#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/tracing/contribution_filter.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

struct TracingSettings {
  // Side of the smallest illuminated patch kept, m; beams narrower than 3.6 times it are not followed to further
  // reflectors. 0 or coarser than that of a body by default: that.
  double min_patch_m = 0;
  int max_bounces = kDefaultBounces;  // 1 <= x <= kMaxBounces
  bool edges = false;                 // edge diffraction
  ContributionFilter filter = {};     // contributions that are summed; beams end at the walls of cavities only
  SolverMethod method = SolverMethod::kBeams;
  double ray_spacing_m = 0;  // distance between rays, m; 0: default_ray_spacing(). Used by rays alone
};

// Tracing settings of a target of a scenario.
TracingSettings tracing_settings(const SolverSpec& solver);

// Distance between rays by default, m: 1.5e-4 of the radius of the target's bounding sphere, 11 mm on the 144 m ship.
double default_ray_spacing(const Scatterer& scatterer);
double ray_spacing(const Scatterer& scatterer, const TracingSettings& settings);  // of the settings, or the default

// Side of the smallest illuminated patch kept by default, m: 0.7e-4 of the radius of the smallest body's bounding
// sphere, 5 mm on the 144 m ship.
double default_min_patch(const Scatterer& scatterer);

// Side of the smallest illuminated patch kept on the smallest body, m: that of the settings, or the default where that
// is finer.
double min_patch(const Scatterer& scatterer, const TracingSettings& settings);

// A tenth of the amplitude k area / 2 pi of the smallest patch, m: end-point and edge contributions below it may be
// left out. On the ship they are -65 dB of the echo together.
double min_amplitude(const Scatterer& scatterer, const TracingSettings& settings, double k);

// Areas of the smallest illuminated patches kept, m^2. Each body has its own, so that the detail of one does not depend
// on what else is in a file. The scatterer must outlive them.
class SmallestAreas {
 public:
  SmallestAreas(const Scatterer& scatterer, const TracingSettings& settings);

  double on(int facet) const {
    return of_surface_[static_cast<std::size_t>(surface_of_[static_cast<std::size_t>(facet)])];
  }

 private:
  std::span<const std::int32_t> surface_of_;
  std::vector<double> of_surface_;
};

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Settings of one illumination: depth of the beams, edge diffraction, and the smallest patches kept.

#include "sim/core/numbers/linear.h"
#include "sim/scattering/beams/contribution_filter.h"
#include "sim/scattering/target/scatterer.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

struct TracingSettings {
  // 14 times the side of the smallest illuminated patch that is kept, m; the smallest beam followed is 3.6 times as
  // wide as that patch. 0 or a value above default_ray_spacing(): default_ray_spacing().
  double ray_spacing_m = 0;
  int max_bounces = kDefaultBounces;  // 1 <= x <= kMaxBounces
  bool edges = false;                 // edge diffraction
  ContributionFilter filter = {};     // contributions that are summed; beams end at the walls of cavities only
  // Radar range for the wavefront curvature, m; 0 = plane wave; else at least ten times the target's radius about the
  // point from which range is counted.
  double range_m = 0;
  Vec3 origin = Vec3::Zero();  // position of the target frame's origin from that point, m
};

// 14 * 0.7e-4 of the target's radius: 0.07 m on the 144 m ship, whose smallest patches are then 5 mm wide.
double default_ray_spacing(const Scatterer& scatterer);

// Spacing of the settings, at most the default one, m.
double ray_spacing(const Scatterer& scatterer, const TracingSettings& settings);

// A tenth of the amplitude k area / 2 pi of the smallest patch, m: end-point and edge contributions below it may be
// left out. On the ship they are -65 dB of the echo together.
double min_amplitude(const Scatterer& scatterer, const TracingSettings& settings, double k);

// Area of the smallest illuminated patch kept, m^2.
double smallest_area(const Scatterer& scatterer, const TracingSettings& settings);

}  // namespace seaglint

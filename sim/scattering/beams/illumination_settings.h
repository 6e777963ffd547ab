// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Which beams, bounces and edges an illumination follows, and how small is left out.

#include "sim/core/numbers/linear.h"
#include "sim/scattering/beams/contribution_filter.h"
#include "sim/scattering/target/scatterer.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

struct TracingSettings {
  // The detail that counts, as the spacing of rays that would find it: lit pieces with a side below a fourteenth are
  // left out, and beams below a quarter of it are not followed to further mirrors. 0 or coarser than
  // default_ray_spacing: that.
  double ray_spacing_m = 0;
  int max_bounces = kDefaultBounces;  // 1 <= x <= kMaxBounces
  bool edges = false;                 // follow the waves that reach sharp edges too
  ContributionFilter filter = {};     // which echoes are summed; all are followed but those into cavities
  // of the radar, 0 = far field; else beyond ten times the target's reach from where it is counted
  double range_m = 0;
  Vec3 origin = Vec3::Zero();  // where the target's frame stands from the point that range_m is counted from, m
};

// 1e-3 of the radius: 0.07 m on the 144 m ship, pieces of 5 mm (README.md).
double default_ray_spacing(const Scatterer& scatterer);

// The spacing whose detail counts: that of the settings, or the default one where that is finer.
double ray_spacing(const Scatterer& scatterer, const TracingSettings& settings);

// A tenth of what the smallest lit piece that counts returns, k area / 2 pi, m: ends of currents and edge waves below
// may be left out. Together they are -65 dB of the ship's echo.
double min_amplitude(const Scatterer& scatterer, const TracingSettings& settings, double k);

// Area of the smallest lit piece that counts, m^2.
double smallest_area(const Scatterer& scatterer, const TracingSettings& settings);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Look directions of a moving radar, and of a radar at a finite range as observed from each body. In the far field only
// the direction matters. The scene is fixed because the sea surface is: the radar's image descends as the radar climbs.

#include "sim/core/numbers/linear.h"
#include "sim/scattering/observation/frequency_response.h"
#include "sim/scattering/observation/sea_reflection.h"

namespace seaglint {

// Look directions of the radar and of its image in the sea at one instant, target frame.
struct LineOfSight {
  RadarBasis radar, image;

  const RadarBasis& of(bool by_sea) const { return by_sea ? image : radar; }
  // Two-way path to x relative to the path to the origin, m, positive when shorter. range_m: distance of the radar from
  // the origin; 0: far field.
  double path_advance(const PropagationPath& path, const Vec3& x, double range_m = 0) const;
};

// The basis of the first pulse, that of r_hat, is transported without rotation about the line of sight; the image's
// basis is its mirror image.
LineOfSight line_of_sight_at(const IntervalSampling& sampling, const Vec3& r_hat, double time_s);

// Both look directions from the point x, transported in the same way.
LineOfSight line_of_sight_from(const LineOfSight& origin, const Vec3& x, double range_m);

}  // namespace seaglint

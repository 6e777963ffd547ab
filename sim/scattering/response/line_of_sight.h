// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A radar that moves past the target, or is near enough to be seen in another direction from each of its bodies: in the
// far field nothing but the direction to it counts. The scene stands still, since the sea as a mirror does: the radar's
// image goes down where the radar goes up.

#include "sim/core/numbers/linear.h"
#include "sim/scattering/response/frequency_response.h"
#include "sim/scattering/response/sea_reflection.h"

namespace seaglint {

// Where the radar and its image in the sea stand at one instant, target frame.
struct LineOfSight {
  RadarBasis radar, image;

  const RadarBasis& of(bool by_sea) const { return by_sea ? image : radar; }
  // Both ways of a path to x, m: its length is shorter by this than to the origin, from which the radar stands at
  // range_m; 0: in the far field.
  double path_advance(const PropagationPath& path, const Vec3& x, double range_m = 0) const;
};

// The first pulse's basis, that of r_hat, is carried along without any turn about the line of sight; the image's is its
// mirror image.
LineOfSight line_of_sight_at(const IntervalSampling& sampling, const Vec3& r_hat, double time_s);

// Both as they are seen from x, likewise without any turn about the line of sight.
LineOfSight line_of_sight_from(const LineOfSight& origin, const Vec3& x, double range_m);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A radar that moves past the target: in the far field nothing but the direction to it counts. The scene stands still,
// since the sea as a mirror does: the radar's image goes down where the radar goes up.

#include "sim/core/linear.h"
#include "sim/scattering/frequency_response.h"
#include "sim/scattering/sea_mirror.h"

namespace seaglint {

// Where the radar and its image in the sea stand at one instant, target frame.
struct Sight {
  RadarBasis radar, image;

  const RadarBasis& of(bool by_sea) const { return by_sea ? image : radar; }
  // Both ways of a path along x, m: its length is shorter by this.
  double gain(const SeaPath& path, const Vec3& x) const { return (of(path.there).r + of(path.back).r).dot(x); }
};

// The first pulse's basis, that of r_hat, is carried along without any turn about the line of sight; the image's is its
// mirror image.
Sight sight_at(const IntervalSampling& sampling, const Vec3& r_hat, double time_s);

}  // namespace seaglint

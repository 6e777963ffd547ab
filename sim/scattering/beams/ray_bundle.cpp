// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/beams/ray_bundle.h"

namespace seaglint {

void BentRays::reflect(const Quadratic& added) {
  phase += compose(added, landing);
  tilt.offset -= added.slope(landing.offset);
  tilt.matrix -= added.hessian * landing.matrix;
}

void BentRays::travel(double s) {
  landing.offset += s * tilt.offset;
  landing.matrix += s * tilt.matrix;
  Quadratic longer = squared(tilt);
  phase.value -= 0.5 * s * longer.value;
  phase.gradient -= 0.5 * s * longer.gradient;
  phase.hessian -= 0.5 * s * longer.hessian;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/geometry/ray_bundle.h"

namespace seaglint {

void ParaxialBundle::reflect(const Quadratic& added) {
  phase += compose(added, position_map);
  direction_map.offset -= added.slope(position_map.offset);
  direction_map.matrix -= added.hessian * position_map.matrix;
}

void ParaxialBundle::propagate(double s) {
  position_map.offset += s * direction_map.offset;
  position_map.matrix += s * direction_map.matrix;
  Quadratic longer = squared(direction_map);
  phase.value -= 0.5 * s * longer.value;
  phase.gradient -= 0.5 * s * longer.gradient;
  phase.hessian -= 0.5 * s * longer.hessian;
}

}  // namespace seaglint

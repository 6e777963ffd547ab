// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Paraxial ray bundle after reflection by curved surfaces.

#include "sim/scattering/geometry/quadratic.h"

namespace seaglint {

// Rays after curved reflectors, to second order about the parallel bundle that flat reflectors would leave (Hamilton's
// characteristic function; G. A. Deschamps, Proc. IEEE 60 (1972) 1022-1035). A ray is identified by the point p where
// it crosses the projection plane. All in the axes of that plane: `position_map`, p to the ray's present position
// across the unfolded ray, m; `direction_map`, p to its tilt, rad; `phase`, path function psi of the ray less that of
// the flat bundle at the same position, m (psi is minus the path). A curved reflector adds its psi and tilts the ray by
// the gradient; over a distance s the ray moves by s tilt and its path grows by s |tilt|^2 / 2.
struct ParaxialBundle {
  Affine position_map{Vec2::Zero(), Mat2::Identity()};
  Affine direction_map;
  Quadratic phase;

  // `added`: psi that the reflector's curvature adds at a point of the projection plane, m.
  void reflect(const Quadratic& added);
  void propagate(double s);  // m
};

}  // namespace seaglint

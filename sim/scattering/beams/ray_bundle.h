// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Rays that curved mirrors have turned a little.

#include "sim/scattering/beams/quadratic.h"

namespace seaglint {

// A bundle of rays behind curved mirrors, to second order about the parallel bundle that flat ones would leave. Rays
// are known by the point p where they cross the aperture; `landing` is where they now are across the unfolded ray,
// `direction_map` how much they are turned (both in the aperture's axes), `phase` what their path has lost against the
// flat one that would reach the landing point (the sign of psi). Hamilton's characteristic function to second order: a
// curved mirror adds its height to the phase and turns the ray by the gradient; over a way s the ray moves by s tilt
// and its path is longer by s |tilt|^2 / 2.
struct ParaxialBundle {
  Affine position_map{Vec2::Zero(), Mat2::Identity()};
  Affine direction_map;
  Quadratic phase;

  // `added`: psi that the mirror's curvature adds at a point of the aperture.
  void reflect(const Quadratic& added);
  void propagate(double s);
};

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Smallest sphere that contains points.

#include <span>

#include "sim/core/numbers/linear.h"

namespace seaglint {

struct Sphere {
  Vec3 centre = Vec3::Zero();
  double radius = 0;  // m
};

// The smallest sphere that contains all points, to rounding: no point lies outside by more than 1e-12 of the radius. It
// turns and moves with the points. Zero for no points, or where none has numbers as coordinates.
Sphere bounding_sphere(std::span<const Vec3> points);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Functions of second order, and affine maps, of a point p in the projection plane.

#include <array>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// value + gradient . p + p . hessian p / 2
struct Quadratic {
  double value = 0;
  Vec2 gradient = Vec2::Zero();
  Mat2 hessian = Mat2::Zero();

  double at(const Vec2& p) const { return value + gradient.dot(p) + 0.5 * p.dot(hessian * p); }
  Vec2 slope(const Vec2& p) const { return gradient + hessian * p; }
  Quadratic& operator+=(const Quadratic& other);
  Quadratic& operator*=(double factor);
};

// offset + matrix p
struct Affine {
  Vec2 offset = Vec2::Zero();
  Mat2 matrix = Mat2::Zero();

  Vec2 at(const Vec2& p) const { return offset + matrix * p; }
};

// q(f(p)) as a function of p.
Quadratic compose(const Quadratic& q, const Affine& f);
// Product of two linear functions, of which value and gradient are used.
Quadratic product(const Quadratic& a, const Quadratic& b);
// |f(p)|^2
Quadratic squared(const Affine& f);

// Barycentric coordinates of a triangle, lambda_i(p) = value[i] + gradient[i] . p: 1 at vertex i, 0 at the two others.
struct Barycentric {
  std::array<double, 3> value{};
  std::array<Vec2, 3> gradient{};

  explicit Barycentric(const std::array<Vec2, 3>& corner);
  double at(int i, const Vec2& p) const { return value[i] + gradient[i].dot(p); }
};

// Quadratic that is zero at the vertices and takes the value middle[i] at the midpoint of side i -> i + 1.
Quadratic edge_midpoint_quadratic(const Barycentric& lambda, const std::array<double, 3>& middle);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Functions of second order of a point p in the projection plane, and the paraxial ray bundles that they describe.

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

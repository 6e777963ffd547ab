// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/geometry/paraxial_bundle.h"

namespace seaglint {

Quadratic& Quadratic::operator+=(const Quadratic& other) {
  value += other.value;
  gradient += other.gradient;
  hessian += other.hessian;
  return *this;
}

Quadratic& Quadratic::operator*=(double factor) {
  value *= factor;
  gradient *= factor;
  hessian *= factor;
  return *this;
}

Quadratic compose(const Quadratic& q, const Affine& f) {
  return {q.at(f.offset), f.matrix.transpose() * q.slope(f.offset), f.matrix.transpose() * q.hessian * f.matrix};
}

Quadratic product(const Quadratic& a, const Quadratic& b) {
  const Mat2 outer = outer_product(a.gradient, b.gradient);
  return {a.value * b.value, a.value * b.gradient + b.value * a.gradient, outer + outer.transpose()};
}

Quadratic squared(const Affine& f) {
  return {f.offset.squaredNorm(), 2 * f.matrix.transpose() * f.offset, 2 * f.matrix.transpose() * f.matrix};
}

Barycentric::Barycentric(const std::array<Vec2, 3>& corner) {
  const Vec2 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
  const double twice_area = e1.x() * e2.y() - e1.y() * e2.x();
  gradient[1] = Vec2(e2.y(), -e2.x()) / twice_area;
  gradient[2] = Vec2(-e1.y(), e1.x()) / twice_area;
  gradient[0] = -gradient[1] - gradient[2];
  for (int i = 0; i < 3; ++i) value[i] = (i == 0 ? 1.0 : 0.0) - gradient[i].dot(corner[0]);
}

Quadratic edge_midpoint_quadratic(const Barycentric& lambda, const std::array<double, 3>& middle) {
  Quadratic sum;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double scale = 4 * middle[i];  // lambda_i lambda_j = 1/4 at the midpoint of the side
    const Mat2 product = outer_product(lambda.gradient[i], lambda.gradient[j]);
    sum += {scale * lambda.value[i] * lambda.value[j],
            scale * (lambda.value[i] * lambda.gradient[j] + lambda.value[j] * lambda.gradient[i]),
            scale * (product + product.transpose())};
  }
  return sum;
}

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

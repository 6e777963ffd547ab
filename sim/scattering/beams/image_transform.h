// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reflections in planes as isometries of space, and planes as heights above the aperture.

#include "sim/scattering/beams/bistatic_geometry.h"
#include "sim/scattering/beams/moving_polygon.h"

namespace seaglint {

// Reflections in planes, composed: image = L real + t, with L orthogonal.
struct ImageTransform {
  Mat3 L = Mat3::Identity();
  Vec3 t = Vec3::Zero();

  Vec3 image(const Vec3& real) const { return L * real + t; }
  Vec3 real(const Vec3& image) const { return L.transpose() * (image - t); }
};

// One after the other: first b.
inline ImageTransform operator*(const ImageTransform& a, const ImageTransform& b) {
  return {a.L * b.L, a.L * b.t + a.t};
}

// By the plane n . x = offset, n unit.
inline ImageTransform plane_reflection(const Vec3& n, double offset) {
  return {Mat3::Identity() - 2 * n * n.transpose(), 2 * offset * n};
}

// A direction as the plane with unit normal n mirrors it.
inline Vec3 reflect_direction(const Vec3& x, const Vec3& n) { return x - 2 * n.dot(x) * n; }

// A facet's plane seen along the unfolded ray: height above the aperture plane z(p) = z0 + slope . p, positive towards
// the radar.
struct DepthPlane {
  double z0 = 0;
  Vec2 slope = Vec2::Zero();

  double at(const Vec2& p) const { return z0 + slope.dot(p); }
  // z as a moving line. Turning r^ moves it by dz/dd_i = p_i + z slope_i at fixed p.
  MovingLine moving() const;
};

// The plane n . x = offset (image space, n need not point to the radar); n . r^ must not vanish.
DepthPlane depth_plane(const Vec3& n, double offset, const RadarBasis& basis);

}  // namespace seaglint

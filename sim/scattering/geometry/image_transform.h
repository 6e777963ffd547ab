// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Image space: reflections in planes as isometries, and planes as heights over the projection plane.

#include <array>

#include "sim/scattering/geometry/look_basis.h"
#include "sim/scattering/geometry/moving_polygon.h"

namespace seaglint {

// Composed reflections, an isometry from real to image space, in which a multiply reflected path is one straight ray:
// image = L real + t, L orthogonal, t in m.
struct ImageTransform {
  Mat3 L = Mat3::Identity();
  Vec3 t = Vec3::Zero();

  Vec3 image(const Vec3& real) const { return L * real + t; }
  Vec3 real(const Vec3& image) const { return L.transpose() * (image - t); }
};

// Composition: b is applied first.
inline ImageTransform operator*(const ImageTransform& a, const ImageTransform& b) {
  return {a.L * b.L, a.L * b.t + a.t};
}

// Reflection in the plane n . x = offset, n unit.
inline ImageTransform plane_reflection(const Vec3& n, double offset) {
  return {Mat3::Identity() - outer_product(2 * n, n), 2 * offset * n};
}

// Direction x reflected in a plane with unit normal n.
inline Vec3 reflect_direction(const Vec3& x, const Vec3& n) { return x - 2 * n.dot(x) * n; }

// Plane over the projection plane: height z(p) = z0 + slope . p in m, positive towards the radar.
struct DepthPlane {
  double z0 = 0;
  Vec2 slope = Vec2::Zero();

  double at(const Vec2& p) const { return z0 + slope.dot(p); }
  // z as a MovingLine: dz/dd_i = p_i + z slope_i at fixed p for a change d_i of r^ along h (i = 1) or v (i = 2).
  MovingLine moving() const;
};

// Heights of the plane n . x = offset, given in image space; either sign of n; n . r^ must not vanish.
DepthPlane depth_plane(const Vec3& n, double offset, const RadarBasis& basis);

// Map of the points of one panel from the projection plane of a receiver to that of the transmitter after reflections,
// affine: q -> origin + q1 first + q2 second, with heights as third component.
class PanelMap {
 public:
  // own: heights of the panel over the receiver's projection plane; image_transform: of the reflectors before it.
  PanelMap(const DepthPlane& own, const RadarBasis& receive, const ImageTransform& image_transform,
           const RadarBasis& transmit);

  // The polygon in the transmitter's projection plane, counter-clockwise. A vertex slides on the panel as it does in
  // the receiver's plane.
  MovingPolygon mapped(const MovingPolygon& polygon) const;
  // Point in the receiver's projection plane.
  Vec2 inverse(const Vec2& p) const;

 private:
  DepthPlane own_;
  Vec3 origin_, first_, second_;  // in the axes h, v, r of the transmitter
  double determinant_;
};

// Division of a beam's cross-section.

// The parts of a cross-section on either side of the middle of a rectangle around it, with sides along and across the
// longest side of its polygons, cut across the longer one. The cut is at rest on the plane that the rays leave,
// `source`, when the look direction changes.
std::array<PolygonSet, 2> halved(const PolygonSet& cross_section, const DepthPlane& source);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Map of the points of one panel from the projection plane of a receiver to that of the transmitter after reflections.

#include "sim/scattering/beams/image_transform.h"

namespace seaglint {

// Affine for the points of a plane: q -> origin + q1 first + q2 second, with heights as third component.
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

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Footprint: part of one panel that one beam illuminates and the receiver sees, the surface of a physical-optics
// integral. Its geometry is independent of frequency; only its phase integral depends on k.

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/scattering/geometry/image_transform.h"
#include "sim/scattering/geometry/moving_polygon.h"
#include "sim/scattering/observation/bistatic_geometry.h"
#include "sim/scattering/radiation/beam_history.h"

namespace seaglint {

struct CurvedFootprint;

struct Footprint {
  MovingPolygon polygon;           // in the projection plane
  DepthPlane plane;                // of the panel's image
  ImageTransform image_transform;  // of the reflectors before the panel
  double psi0 = 0;                 // minus the two-way path: psi(p) = psi0 + w . p, m
  Vec2 w = Vec2::Zero();
  double psi_slope = 0;              // |gradient of psi| along the panel, 0..2
  double psi_slope_rate = 0;         // bound of its change per radian of look direction, 0..2
  double panel_size = 0;             // longest distance between two vertices of the panel, m
  std::array<Complex, 4> pattern{};  // hh, hv, vh, vv (received, transmitted) of n x (k^ x E) / |n . k^|
  // The same per wavenumber of the illumination where a material on the path depends on them, `pattern` being the
  // middle one; empty where `pattern` holds for all.
  std::vector<std::array<Complex, 4>> patterns;
  int facet = -1;          // representative facet of the panel
  std::uint16_t part = 0;  // of that facet
  std::uint8_t bounces = 1;
  BeamHistory history;                               // of the beam
  std::shared_ptr<const CurvedFootprint> curvature;  // null when the facet and all reflectors are flat

  // Of the flat facet, m.
  double psi(const Vec2& p) const { return psi0 + w.dot(p); }
  // Dot product, m^2, of two steps on the panel, and length of one, m, given in the projection plane.
  double surface_dot(const Vec2& a, const Vec2& b) const { return a.dot(b) + plane.slope.dot(a) * plane.slope.dot(b); }
  double surface_length(const Vec2& step) const { return std::sqrt(surface_dot(step, step)); }
};

// Sets psi0, w and the surface slopes from plane and image transform. n_image: unit normal of the panel's image.
void set_phase(Footprint& footprint, const Vec3& n_image, const BistaticGeometry& geometry);

// Of the body-fixed point at p.
PathGradient phase_gradient(const Footprint& footprint, const Vec2& p, const RadarBasis& transmit);

// Of a vertex that slides on the panel as the look direction changes: adds w . slide to the transmitter's part.
PathGradient phase_gradient(const Footprint& footprint, const MovingVertex& vertex, const RadarBasis& transmit);

// Limits the slide rate of the polygon's vertices to `max`, m in the projection plane per radian. A shadow boundary
// slides at a rate equal to the distance between the obstructing edge and the panel. Only the intersection of two
// nearly parallel polygon sides moves faster, and it soon reaches the end of one of them, where the rate no longer
// predicts its position. The limit depends on the vertex alone, so that polygons with a common vertex keep a common
// rate.
void limit_slide_rate(Footprint& footprint, double max);

}  // namespace seaglint

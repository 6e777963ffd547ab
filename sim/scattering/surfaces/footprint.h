// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A footprint: a piece of one facet, lit through one sequence of flat mirrors and seen by the radar. Its geometry holds
// for all frequencies; only its phase integral depends on k.

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/scattering/beams/bistatic_geometry.h"
#include "sim/scattering/beams/image_transform.h"
#include "sim/scattering/beams/moving_polygon.h"

namespace seaglint {

struct CurvedFootprint;

struct Footprint {
  MovingPolygon polygon;           // in the aperture plane
  DepthPlane plane;                // of the last facet's image
  ImageTransform image_transform;  // of the facets before the last
  double psi0 = 0;                 // minus the two-way path, psi(p) = psi0 + w . p, m
  Vec2 w = Vec2::Zero();
  double psi_slope = 0;              // |gradient of psi| along the facet itself, 0..2
  double psi_slope_rate = 0;         // bound of its change per radian of turn, 0..2
  double panel_size = 0;             // longest distance of two corners of its panel, m
  std::array<Complex, 4> pattern{};  // hh, hv, vh, vv (received, transmitted) of n x (k^ x E) / |n . k^|
  // The same for each of the illumination's wavenumbers where a material on the way makes it depend on them, pattern
  // being the middle one; empty where pattern serves all.
  std::vector<std::array<Complex, 4>> patterns;
  int facet = -1;          // the last one
  std::uint16_t part = 0;  // its part
  std::uint8_t bounces = 1;
  std::shared_ptr<const CurvedFootprint> curvature;  // null when the facet and all mirrors are flat

  // Of the flat facet.
  double psi(const Vec2& p) const { return psi0 + w.dot(p); }
  // Length on the facet of a step in the aperture, m.
  double surface_length(const Vec2& step) const {
    const double rise = plane.slope.dot(step);
    return std::sqrt(step.squaredNorm() + rise * rise);
  }
};

// Fills psi0, w and the surface slopes from plane and mirrors. n_image: unit normal of the last facet's image.
void set_phase(Footprint& footprint, const Vec3& n_image, const BistaticGeometry& geometry);

// How psi changes as the directions turn, m: d psi = transmit . d r^_t + receive . d r^_s. One direction for both:
// their sum. Points of the body give their places, x_image to the transmitter and x_real to the receiver (Fermat);
// corners that slip in the body give more.
struct PathGradient {
  Vec3 transmit = Vec3::Zero();
  Vec3 receive = Vec3::Zero();
  Vec3 transmit_slide = Vec3::Zero(), receive_slide = Vec3::Zero();  // what of them is slip

  Vec3 sum() const { return transmit + receive; }
};

// On the way from a to b, 0 <= s <= 1.
PathGradient interpolate(const PathGradient& a, const PathGradient& b, double s);

// For the body-fixed point at p.
PathGradient phase_gradient(const Footprint& footprint, const Vec2& p, const RadarBasis& transmit);

// The same for a corner that moves in the facet as the direction turns: adds w . slip to the transmitter's part.
PathGradient phase_gradient(const Footprint& footprint, const MovingVertex& vertex, const RadarBasis& transmit);

// Slows corners down that slip in the facet by more than `most`, m of the aperture per radian. A shadow edge slips by
// the distance between what casts it and the facet; only where two edges cross that are nearly parallel a corner runs
// faster, and soon off the end of one of them, so that its way cannot be told from its speed. The speed is the corner's
// own: pieces that share it still do.
void limit_slide_rate(Footprint& footprint, double max);

}  // namespace seaglint

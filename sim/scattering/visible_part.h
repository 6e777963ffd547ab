// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Hidden surfaces among a handful of facets, as polygons of the aperture plane.

#include <array>
#include <vector>

#include "sim/scattering/footprint.h"

namespace seaglint {

// Facets nearer to each other than this are one surface: 1e-5 of a 10 mm wavelength.
inline constexpr double kCoincident = 1e-7;  // m

// Height of plane b above plane a as a moving line: positive where b is nearer to the radar along the unfolded ray.
MovingLine depth_between(const ImagePlane& a, const ImagePlane& b);

// The part of b's image that lies nearer to the radar than plane a. Facets that coincide are ordered by number, the
// lower one in front.
MovingPolygon nearer_part(const MovingPolygon& image_b, const ImagePlane& plane_b, int facet_b,
                          const ImagePlane& plane_a, int facet_a);

// Takes the hole out of every piece; pieces it does not touch stay as they are.
void cut(std::vector<MovingPolygon>& pieces, const MovingPolygon& hole, double min_area);

// The shadow that a triangle throws along -r^ onto the plane n . x = offset (real space), as a polygon of the aperture
// in which that plane is seen through the mirrors. n points to the radar's side. Empty when the triangle does not stand
// above the plane.
MovingPolygon shadow_on(const std::array<Vec3, 3>& triangle, const Vec3& n, double offset, const Mirror& mirrors,
                        const RadarBasis& basis);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Tolerances of the geometry that the solver's rooms share. A vertex is exact to the rounding of coordinates of some
// 100 m, 1e-14 m, times the operations of a clip; the smallest patch kept on the smallest targets is 1e-5 m wide.

namespace seaglint {

// Points, lines and planes nearer to each other than this coincide, m: vertices on an edge, panels in one plane, edges
// that meet, lengths that count as zero.
inline constexpr double kCoincident = 1e-7;

// Angle, or its sine, below which a direction lies in a plane, rad: panels observed edge-on, diffracted rays on a
// shadow boundary, and the tilt of a grazing wave towards its face, by which rounding does not move it to the other
// side.
inline constexpr double kInPlaneAngle = 1e-7;

// 1 - cosine between the normals of facets that belong to one flat face; deviation of a wedge index from a right angle.
inline constexpr double kFlat = 1e-6;

// |cosine| below which a facet is edge-on to a beam or to the receiver.
inline constexpr double kEdgeOn = 1e-9;

}  // namespace seaglint

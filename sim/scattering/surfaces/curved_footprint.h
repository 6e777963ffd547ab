// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What curvature adds to a flat footprint: the phase of a surface that stands above its facet and of rays that curved
// mirrors have turned, the direction of its normal from corner to corner, and the fading of its currents towards the
// shadow boundary (README.md, "Curved surfaces").

#include <array>
#include <memory>

#include "sim/scattering/beams/curved_reflection.h"
#include "sim/scattering/surfaces/footprint.h"
#include "sim/scattering/target/panels.h"

namespace seaglint {

// Of a triangle that holds all a beam lights on a panel: the curved facet itself, or one around the whole flat panel.
// Shared by all pieces of the footprint. Arrays go by the triangle's corners.
struct CurvedFootprint {
  std::array<Vec2, 3> corner;
  Barycentric lambda;
  Quadratic phase;        // psi minus that of the flat facet
  std::array<Vec2, 3> w;  // gradient of the whole psi with the smooth normals: continuous from facet to facet
  // the same along the surface, 0..2, as its components along a step in the aperture on the flat facet
  std::array<Vec2, 3> slope;
  // as Footprint::pattern, with the smooth normals where all is perfect conductor
  std::array<std::array<Complex, 4>, 3> pattern;
  Complex divergence_factor = 1;  // factor of the amplitude for rays that curved mirrors have spread
  // distances from the shadow boundaries of the incident wave and of the receiver, m^(1/3)
  std::array<double, 3> incident_shadow_distance, receiver_shadow_distance;
};

// What the curvature of a facet and of the mirrors before it adds to a footprint whose flat phase and pattern are set;
// null where all are flat. Its triangle is the curved facet, or holds the whole flat panel.
std::shared_ptr<const CurvedFootprint> make_curved_footprint(const CurvatureContext& on, const Panels& panels,
                                                             const BistaticGeometry& geometry,
                                                             const BeamSegment& segment,
                                                             const CandidatePanel& candidate,
                                                             const Footprint& footprint);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Physical-optics contributions of a beam on a panel, for one receiver, with the curvature terms of their footprints.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/radiation/beam_boundary.h"
#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/tracing/curved_reflection.h"
#include "sim/scattering/tracing/interaction.h"

namespace seaglint {

// Curvature terms of a footprint: phase of a surface that rises above its flat facet, phase and divergence of rays
// reflected by curved reflectors, surface normals interpolated between the facet's vertices, and the taper of the
// current at the smooth-surface shadow boundary (README.md, "Curved surfaces"). Of a triangle that contains everything
// one beam illuminates on a panel: the curved facet itself, or one around the beam on a flat panel. Shared by all
// polygons of the footprint. Arrays are indexed by the vertices of the triangle.
struct CurvedFootprint {
  std::array<Vec2, 3> corner;
  Barycentric lambda;
  Quadratic phase;           // psi minus that of the flat facet, m
  std::array<Vec2, 3> w;     // gradient of psi with the smooth normals, continuous between facets
  std::array<Vec2, 3> rise;  // gradient of DepthPlane::at of the tangent planes, continuous between facets
  // gradient of psi along the surface, magnitude 0..2, as components along a step on the flat facet in the projection
  // plane
  std::array<Vec2, 3> slope;
  // of the surface, with the smooth normals where all surfaces are perfect conductors
  std::array<ScatteringMatrix, 3> pattern;
  bool has_bundle = false;  // a reflector before the panel is curved
  bool flat_panel = false;  // the panel is not: psi and its gradient hold at every point
  ArrivingRays rays;        // where has_bundle
  // distances from the shadow boundaries of the incident wave and of the receiver, in units of m^(1/3); see
  // kTransitionZoneWidth
  std::array<double, 3> incident_shadow_distance, receiver_shadow_distance;

  // Amplitude factor of the ray p of a bundle that curved reflectors have widened: the area that it illuminates on the
  // panel, relative to that of the flat bundle, over the square root of the widening across the ray; +90 deg behind one
  // caustic, 180 deg behind two.
  Complex divergence_factor(const Vec2& p) const;
};

// Pattern at the point p, interpolated between the vertices of the facet.
ScatteringMatrix smooth_pattern(const CurvedFootprint& curvature, const Vec2& p);

// Curvature terms of a footprint whose flat phase is set, with its flat pattern; null where the facet and all
// reflectors are flat. The triangle is the curved facet, or encloses the beam on a flat panel.
std::shared_ptr<const CurvedFootprint> make_curved_footprint(const CurvatureContext& on,
                                                             const BistaticGeometry& geometry,
                                                             const Interaction& interaction, const Footprint& footprint,
                                                             const Pattern& pattern);

// Physical-optics contributions of a beam on a panel, for one receiver, and the boundary terms of their footprints.
// Appends to `out`, which must outlive the object, as must the scene with the receiver.
class SurfaceRadiator {
 public:
  SurfaceRadiator(const TracingContext& scene, const Receiver& receiver, std::vector<Contribution>& out);

  // Appends the contributions of the polygons `pieces`, the illuminated and visible part of the panel.
  void radiate(const Interaction& interaction, std::span<const MovingPolygon> pieces);

 private:
  Contribution contribution_of(const Interaction& interaction, const ImageTransform& image_transform,
                               int bounces) const;
  void radiate_panel(const Interaction& interaction, std::span<const MovingPolygon> pieces);
  void radiate_image(const Interaction& interaction, std::span<const MovingPolygon> visible);
  // Pattern per wavenumber, where the panel or a reflector before it is not a perfect conductor.
  std::vector<ScatteringMatrix> patterns(const BeamSegment& segment, int facet, const Vec3& n) const;
  // True where the grazing treatment applies (fade_windows.h): one antenna, edge diffraction on, flat perfect
  // conductors, no cavity walls.
  bool uses_grazing_treatment(const BeamSegment& segment, int facet) const;
  ReflectorPanel reflector_panel(int facet) const;
  double path_weight(const BeamSegment& segment, int last) const;

  const TracingContext& scene_;
  std::span<const Facet> facets_;
  CurvatureContext curvature_;
  const Panels& panels_;
  const BistaticGeometry& geometry_;
  const VisibleSurface& visible_;
  const RadarBasis& basis_;  // projection plane: that of the transmitter
  double max_slide_rate_;    // m/rad
  std::vector<Contribution>& out_;
  FootprintBoundary boundary_;
};

}  // namespace seaglint

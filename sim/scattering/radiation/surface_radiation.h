// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Physical-optics contributions of a beam on a panel, for one receiver, and the boundary terms of their footprints.

#include <span>
#include <vector>

#include "sim/scattering/coefficients/path_weights.h"
#include "sim/scattering/radiation/beam_boundary.h"
#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/radiation/curved_footprint.h"
#include "sim/scattering/tracing/interaction.h"

namespace seaglint {

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
  // True where the grazing treatment applies (path_weights.h): one antenna, edge diffraction on, flat perfect
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

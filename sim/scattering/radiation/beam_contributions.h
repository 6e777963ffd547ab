// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Physical-optics footprints of a beam on a panel, for one receiver.

#include <array>
#include <span>
#include <vector>

#include "sim/scattering/coefficients/path_weights.h"
#include "sim/scattering/radiation/curved_footprint.h"
#include "sim/scattering/radiation/footprint.h"
#include "sim/scattering/scatterer/panels.h"
#include "sim/scattering/tracing/beam_segment.h"
#include "sim/scattering/tracing/tracing_context.h"

namespace seaglint {

// Receives the footprints of every beam on every panel, with their full pattern where the grazing treatment reduces
// them.
class FootprintVisitor {
 public:
  virtual ~FootprintVisitor() = default;
  // Called once per beam and panel, with the footprint but for its polygon.
  virtual void start(const BeamSegment& segment, const CandidatePanel& candidate, const Footprint& footprint) = 0;
  // Called for each footprint of that beam and panel.
  virtual void add(const Footprint& footprint) = 0;
};

// Footprints for one receiver. Appends to `out`; `out`, the scene with the receiver, and the visitor (may be null) must
// outlive the object.
class BeamContributions {
 public:
  BeamContributions(const TracingContext& scene, const Receiver& receiver, std::vector<Footprint>& out,
                    FootprintVisitor* visitor = nullptr);

  // Appends the footprints of the polygons `pieces`, the illuminated and visible part of the panel.
  void radiate(const BeamSegment& segment, const CandidatePanel& candidate, std::span<const MovingPolygon> pieces);

  // Appends the footprints of the path that returns via its first reflector, where the grazing treatment applies: the
  // panel's image in that reflector radiates instead (image theory). `visible`: visible part of the panel.
  void radiate_image(const BeamSegment& segment, const CandidatePanel& candidate,
                     std::span<const MovingPolygon> visible);

 private:
  // Pattern per wavenumber, where the panel or a reflector before it is not a perfect conductor.
  std::vector<std::array<Complex, 4>> patterns(const BeamSegment& segment, int facet, const Vec3& n) const;
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
  const VisibleSurface* visible_;
  const RadarBasis& basis_;  // projection plane: that of the transmitter
  double max_slide_rate_;    // m/rad
  std::vector<Footprint>& out_;
  FootprintVisitor* visitor_;
};

}  // namespace seaglint

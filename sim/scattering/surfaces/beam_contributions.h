// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The footprints of physical optics that a beam leaves on a panel.

#include <array>
#include <span>
#include <vector>

#include "sim/scattering/beams/beam_segment.h"
#include "sim/scattering/beams/tracing_context.h"
#include "sim/scattering/surfaces/curved_footprint.h"
#include "sim/scattering/surfaces/footprint.h"
#include "sim/scattering/surfaces/grazing_reflection.h"

namespace seaglint {

// Receives the footprints of every beam on every panel, those whose echo grazing lowers still with their whole pattern.
class FootprintVisitor {
 public:
  virtual ~FootprintVisitor() = default;
  // Of one beam on one panel, but for the polygon.
  virtual void start(const BeamSegment& segment, const CandidatePanel& candidate, const Footprint& footprint) = 0;
  // One of its footprints.
  virtual void add(const Footprint& footprint) = 0;
};

// Of one receiver. Appends to `out`; it, the scene with the receiver, and the visitor, which may be null, must outlive
// this.
class BeamContributions {
 public:
  BeamContributions(const TracingContext& scene, const Receiver& receiver, std::vector<Footprint>& out,
                    FootprintVisitor* visitor = nullptr);

  // Footprints of the pieces that are lit and seen.
  void radiate(const BeamSegment& segment, const CandidatePanel& candidate, std::span<const MovingPolygon> pieces);

  // Footprints of what leaves by the mirror that it came by first, where that is grazed: of the facet's image in it,
  // lit and seen directly. `seen`: pieces of the facet that the radar sees.
  void radiate_image(const BeamSegment& segment, const CandidatePanel& candidate,
                     std::span<const MovingPolygon> visible);

 private:
  // The footprint's pattern per wavenumber, where the facet or a mirror before it is no perfect conductor.
  std::vector<std::array<Complex, 4>> patterns(const BeamSegment& segment, int facet, const Vec3& n) const;
  // Whether mirrors that are grazed leave their echo to other ways; without edges the last one has all of it, as usual.
  // Flat perfect conductors, and none that are followed by other means.
  bool uses_grazing_treatment(const BeamSegment& segment, int facet) const;
  ReflectorPanel reflector_panel(int facet) const;
  double path_weight(const BeamSegment& segment, int last) const;

  const TracingContext& scene_;
  std::span<const Facet> facets_;
  CurvatureContext curvature_;
  const Panels& panels_;
  const BistaticGeometry& geometry_;
  const VisibleSurface& visible_;
  const RadarBasis& basis_;  // of the aperture: the transmitter's
  double max_slide_rate_;    // m
  std::vector<Footprint>& out_;
  FootprintVisitor* visitor_;
};

}  // namespace seaglint

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
  virtual void start(const Leg& leg, const Candidate& candidate, const Footprint& footprint) = 0;
  // One of its footprints.
  virtual void add(const Footprint& footprint) = 0;
};

// Of one receiver. Appends to `out`; it, the scene with the receiver, and the visitor, which may be null, must outlive
// this.
class BeamEcho {
 public:
  BeamEcho(const BeamScene& scene, const Receiver& receiver, std::vector<Footprint>& out,
           FootprintVisitor* visitor = nullptr);

  // Footprints of the pieces that are lit and seen.
  void radiate(const Leg& leg, const Candidate& candidate, std::span<const MovingPolygon> pieces);

  // Footprints of what leaves by the mirror that it came by first, where that is grazed: of the facet's image in it,
  // lit and seen directly. `seen`: pieces of the facet that the radar sees.
  void radiate_back(const Leg& leg, const Candidate& candidate, std::span<const MovingPolygon> seen);

 private:
  // The footprint's pattern per wavenumber, where the facet or a mirror before it is no perfect conductor.
  std::vector<std::array<Complex, 4>> patterns(const Leg& leg, int facet, const Vec3& n) const;
  // Whether mirrors that are grazed leave their echo to other ways; without edges the last one has all of it, as usual.
  // Flat perfect conductors, and none that are followed by other means.
  bool leaves_grazing(const Leg& leg, int facet) const;
  GrazedMirror mirror_of(int facet) const;
  double share_of_way(const Leg& leg, int last) const;

  const BeamScene& scene_;
  std::span<const Facet> facets_;
  Curving curving_;
  const Panels& panels_;
  const AntennaPair& antennas_;
  const VisibleSurface& visible_;
  const RadarBasis& basis_;  // of the aperture: the transmitter's
  double longest_slip_;      // m
  std::vector<Footprint>& out_;
  FootprintVisitor* visitor_;
};

}  // namespace seaglint

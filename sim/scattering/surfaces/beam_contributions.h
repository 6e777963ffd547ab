// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a beam answers from a facet that it lights: footprints of physical optics, what these lack where the beam ends,
// and the waves that it brings to sharp edges.

#include <array>
#include <span>
#include <vector>

#include "sim/scattering/beams/beam_segment.h"
#include "sim/scattering/beams/tracing_context.h"
#include "sim/scattering/surfaces/curved_reflection.h"
#include "sim/scattering/surfaces/grazing_reflection.h"

namespace seaglint {

// Appends to `out`; it and the scene must outlive this.
class BeamEcho {
 public:
  BeamEcho(const BeamScene& scene, Lit& out);

  // Appends what the radar sees directly of the candidate's lit pieces to `seen`.
  void seen_part(const Leg& leg, const Candidate& candidate, std::vector<MovingPolygon>& seen) const;

  // Footprints of the pieces that are lit and seen.
  void radiate(const Leg& leg, const Candidate& candidate, std::span<const MovingPolygon> pieces);

  // Footprints of what leaves by the mirror that it came by first, where that is grazed: of the facet's image in it,
  // lit and seen directly. `seen`: pieces of the facet that the radar sees.
  void radiate_back(const Leg& leg, const Candidate& candidate, std::span<const MovingPolygon> seen);

  // Whether the leg's waves are followed to edges: with more mirrors before it an edge is not.
  bool reaches_edges(const Leg& leg) const;

  // Arrivals at the candidate's edges. Wedges are perfect conductors, and so is what the wave met before.
  void reach_edges(const Leg& leg, const Candidate& candidate);

 private:
  // The footprint's pattern per wavenumber, where the facet or a mirror before it is no perfect conductor.
  std::vector<std::array<Complex, 4>> patterns(const Leg& leg, int facet, const Vec3& n) const;
  // Perfect conductors, as wedges are, and flat.
  bool has_beam_ends(const Leg& leg, const Footprint& footprint) const;
  // Whether mirrors that are grazed leave their echo to other ways; without edges the last one has all of it, as usual.
  // Flat perfect conductors, and none that are followed by other means.
  bool leaves_grazing(const Leg& leg, int facet) const;
  GrazedMirror mirror_of(int facet) const;
  double share_of_way(const Leg& leg, int last) const;

  const BeamScene& scene_;
  std::span<const Facet> facets_;
  Curving curving_;
  const Panels& panels_;
  const SharpEdges* edges_;  // null when nobody asks for edges
  const AntennaPair& antennas_;
  const RadarBasis& basis_;  // of the aperture: the transmitter's
  double longest_slip_;      // m
  Lit& out_;
};

}  // namespace seaglint

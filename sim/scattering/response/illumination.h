// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Shooting and bouncing rays, with polygons in place of rays: a beam is a bundle of parallel rays, a tree finds the
// facets it may meet, and the polygons of those facets measure exactly what is lit and seen (sim/scattering/README.md).
// The result holds for every frequency.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/beams/bistatic_geometry.h"
#include "sim/scattering/beams/illumination_settings.h"
#include "sim/scattering/beams/tracing_context.h"
#include "sim/scattering/beams/visible_surface.h"
#include "sim/scattering/edges/edge_contribution.h"
#include "sim/scattering/edges/edge_illumination.h"
#include "sim/scattering/material/material.h"
#include "sim/scattering/surfaces/footprint.h"

namespace seaglint {

// What the beams that leave one facet, or several, meet.
struct Lit {
  // By receiver, what it sees of that: footprints, and what physical optics lacks where their beams end.
  struct Seen {
    std::vector<Footprint> footprints;
    std::vector<EdgeFootprint> beam_ends;
  };
  std::vector<Seen> seen;
  std::vector<EdgeArrival> arrivals;  // only when the settings ask for edges, as are the ends
};

// What one receiver sees of one panel's beams, as far as it is told at once: edges answer when all has reached them.
struct PanelEchoes {
  std::span<const Footprint> footprints;
  std::span<const EdgeFootprint> beam_ends;
};

// The waves that reached sharp edges, and the number of legs followed, a beam's way from one mirror to the next.
struct Reached {
  ArrivalsByEdge arrivals;
  std::size_t legs = 0;
};

// A direction, and what is seen from it of every panel.
struct Aspect {
  RadarBasis basis;  // turned aside by 1e-6 rad where faces or edges have only a limit (illumination.cpp)
  VisibleSurface visible;

  Aspect(const Scatterer& scatterer, const RadarBasis& direction, const IlluminationSettings& settings, int threads);
};

// Of one transmitter and any number of receivers; a null receiver is the transmitter's antenna.
struct Aspects {
  std::shared_ptr<const Aspect> transmitter;
  std::vector<std::shared_ptr<const Aspect>> receivers;
};

// What one direction lights and others, or the same, see. light() follows the beams that leave one facet; facets are
// independent and may be lit in any order by any thread.
class Illumination {
 public:
  // wavenumbers: those at which materials are evaluated and what is faint is left out. A perfect conductor needs none,
  // and all of it counts then.
  Illumination(const Scatterer& scatterer, Aspects aspects, const IlluminationSettings& settings,
               std::span<const double> wavenumbers = {});

  // Of one receiver.
  Illumination(const Scatterer& scatterer, const AntennaPair& antennas, const IlluminationSettings& settings,
               int threads = 1, std::span<const double> wavenumbers = {});

  // Panels the transmitter sees, by the facets they go by, ascending.
  std::span<const int> seen() const { return seen_; }

  // Lights everything chunk by chunk of panels, on `threads` threads: visit(chunk, receiver, echoes) gets what a
  // receiver sees of each chunk, panel by panel in order, from one thread or another, without what the settings' filter
  // leaves out and the ends of beams that are faint at the illumination's wavenumbers. Chunks do not depend on the
  // number of threads. Throws Interrupted when *stop becomes true.
  std::size_t chunk_count() const;
  using Visit = std::function<void(std::size_t chunk, std::size_t receiver, const PanelEchoes& echoes)>;
  Reached light_all(int threads, const Visit& visit, const StopFlag* stop = nullptr) const;

  // Appends what all beams light whose first mirror is the panel of one of these facets, their own first bounce
  // included; returns the legs followed.
  std::size_t light(int facet, Lit& lit) const { return light({&facet, 1}, lit); }
  std::size_t light(std::span<const int> facets, Lit& lit) const;

 private:
  std::size_t panels_per_chunk() const;
  BeamScene scene() const;

  const Scatterer& scatterer_;
  IlluminationSettings settings_;
  Aspects aspects_;
  std::vector<Receiver> receivers_;
  std::vector<int> seen_;
  std::vector<std::vector<Surface>> surfaces_;  // [material][wavenumber]; none for a perfect conductor
  double lowest_ = 0, highest_ = 0;             // of the wavenumbers; 0: there are none
};

}  // namespace seaglint

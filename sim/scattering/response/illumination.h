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
struct TracedContributions {
  // By receiver, what it sees of that: footprints, and what physical optics lacks where their beams end.
  struct Seen {
    std::vector<Footprint> footprints;
    std::vector<EdgeContribution> beam_ends;
  };
  std::vector<Seen> seen;
  std::vector<EdgeIllumination> edge_illuminations;  // only when the settings ask for edges, as are the ends
};

// What one receiver sees of one panel's beams, as far as it is told at once: edges answer when all has reached them.
struct PanelContributions {
  std::span<const Footprint> footprints;
  std::span<const EdgeContribution> boundary_terms;
};

// The waves that reached sharp edges, and the number of legs followed, a beam's way from one mirror to the next.
struct TraceSummary {
  IlluminationByEdge edge_illuminations;
  std::size_t segments = 0;
};

// A direction, and what is seen from it of every panel.
struct Aspect {
  RadarBasis basis;  // turned aside by 1e-6 rad where faces or edges have only a limit (illumination.cpp)
  VisibleSurface visible;

  Aspect(const Scatterer& scatterer, const RadarBasis& direction, const TracingSettings& settings, int threads);
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
  Illumination(const Scatterer& scatterer, Aspects aspects, const TracingSettings& settings,
               std::span<const double> wavenumbers = {});

  // Of one receiver.
  Illumination(const Scatterer& scatterer, const BistaticGeometry& geometry, const TracingSettings& settings,
               int threads = 1, std::span<const double> wavenumbers = {});

  // Panels the transmitter sees, by the facets they go by, ascending.
  std::span<const int> visible_panels() const { return seen_; }

  // Lights everything chunk by chunk of panels, on `threads` threads: visit(chunk, receiver, echoes) gets what a
  // receiver sees of each chunk, panel by panel in order, from one thread or another, without what the settings' filter
  // leaves out and the ends of beams that are faint at the illumination's wavenumbers. Chunks do not depend on the
  // number of threads. Throws Interrupted when *stop becomes true.
  std::size_t chunk_count() const;
  using Visit = std::function<void(std::size_t chunk, std::size_t receiver, const PanelContributions& contributions)>;
  TraceSummary trace_all(int threads, const Visit& visit, const StopFlag* stop = nullptr) const;

  // Appends what all beams light whose first mirror is the panel of one of these facets, their own first bounce
  // included; returns the legs followed.
  std::size_t trace_from(int facet, TracedContributions& lit) const { return trace_from({&facet, 1}, lit); }
  std::size_t trace_from(std::span<const int> facets, TracedContributions& traced) const;

 private:
  std::size_t panels_per_chunk() const;
  TracingContext scene() const;

  const Scatterer& scatterer_;
  TracingSettings settings_;
  Aspects aspects_;
  std::vector<Receiver> receivers_;
  std::vector<int> seen_;
  std::vector<std::vector<MaterialSurface>> surfaces_;  // [material][wavenumber]; none for a perfect conductor
  double lowest_ = 0, highest_ = 0;                     // of the wavenumbers; 0: there are none
};

}  // namespace seaglint

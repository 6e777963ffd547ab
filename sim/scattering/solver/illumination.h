// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Illumination of a target from one direction: traces the beams from every visible panel, or tubes of rays from every
// tile of a lattice, and collects surface contributions, boundary terms and edge illuminations. Both are bundles of
// parallel rays of polygonal cross-section (tracing/README.md, tracing/README.md). The geometry is independent of
// frequency.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/observation/bistatic_geometry.h"
#include "sim/scattering/radiation/edge_contribution.h"
#include "sim/scattering/radiation/footprint.h"
#include "sim/scattering/tracing/edge_illumination.h"
#include "sim/scattering/tracing/illumination_settings.h"
#include "sim/scattering/tracing/ray_lattice.h"
#include "sim/scattering/tracing/tracing_context.h"
#include "sim/scattering/tracing/visible_surface.h"

namespace seaglint {

// Contributions of the beams that leave one or several panels.
struct TracedContributions {
  // Of one receiver: footprints, and the boundary terms of their beams.
  struct OfReceiver {
    std::vector<Footprint> footprints;
    std::vector<EdgeContribution> boundary_terms;
  };
  std::vector<OfReceiver> receivers;
  std::vector<EdgeIllumination> edge_illuminations;  // filled, as boundary_terms are, with edge diffraction on
};

// Contributions of one panel's beams to one receiver. Edge contributions follow once all edge illuminations are
// collected.
struct PanelContributions {
  std::span<const Footprint> footprints;
  std::span<const EdgeContribution> boundary_terms;
};

// Edge illuminations, and the number of beam segments traced.
struct TraceSummary {
  IlluminationByEdge edge_illuminations;
  std::size_t segments = 0;
};

// A look direction and the visible part of every panel, which rays need for edge diffraction only.
struct Aspect {
  RadarBasis basis;  // perturbed by 1e-6 rad where faces or edges have only a limit (illumination.cpp)
  std::optional<VisibleSurface> visible;

  Aspect(const Scatterer& scatterer, const RadarBasis& direction, const TracingSettings& settings, int threads);
};

// One transmit direction and any number of receive directions; a null receiver is the transmitter's antenna.
struct Aspects {
  std::shared_ptr<const Aspect> transmitter;
  std::vector<std::shared_ptr<const Aspect>> receivers;
};

// Traces the beams or rays of one transmit direction for its receivers. trace_from() follows the beams of one panel;
// panels and tiles are independent and may be traced in any order by any thread.
class Illumination {
 public:
  // `wavenumbers`: at which materials are evaluated and weak boundary terms are omitted. May be empty for perfect
  // conductors; nothing is omitted then.
  Illumination(const Scatterer& scatterer, Aspects aspects, const TracingSettings& settings,
               std::span<const double> wavenumbers = {});

  // For one receiver.
  Illumination(const Scatterer& scatterer, const BistaticGeometry& geometry, const TracingSettings& settings,
               int threads = 1, std::span<const double> wavenumbers = {});

  // Panels visible to the transmitter, by their representative facets, ascending; none for rays.
  std::span<const int> visible_panels() const { return seen_; }

  // Traces all panels or tiles in chunks on `threads` threads. visit(chunk, receiver, contributions) receives the
  // contributions of each chunk panel by panel or tile by tile, in order and from one thread, without those that the
  // filter of the settings rejects and without boundary terms that are negligible at the wavenumbers. Chunks do not
  // depend on the number of threads. Throws Interrupted when *stop becomes true.
  std::size_t chunk_count() const;
  using Visit = std::function<void(std::size_t chunk, std::size_t receiver, const PanelContributions& contributions)>;
  // `complete`, unless empty, is called after the last contributions of a chunk.
  TraceSummary trace_all(int threads, const Visit& visit, const StopFlag* stop = nullptr,
                         const std::function<void(std::size_t chunk)>& complete = {}) const;

  // Appends the contributions of all beams whose first reflector is the panel of one of these facets, its direct
  // illumination included; returns the number of beam segments traced. By the method of beams only.
  std::size_t trace_from(int facet, TracedContributions& traced) const { return trace_from({&facet, 1}, traced); }
  std::size_t trace_from(std::span<const int> facets, TracedContributions& traced) const;

 private:
  std::size_t items() const;  // panels, or tiles of rays
  std::size_t items_per_chunk() const;
  TracingContext scene() const;

  const Scatterer& scatterer_;
  TracingSettings settings_;
  Aspects aspects_;
  std::vector<Receiver> receivers_;
  std::vector<int> seen_;
  std::optional<RayLattice> lattice_;                   // of the method of rays
  std::vector<std::vector<MaterialSurface>> surfaces_;  // [material][wavenumber]; empty for a perfect conductor
  double lowest_ = 0, highest_ = 0;                     // of the wavenumbers; 0: none given
};

}  // namespace seaglint

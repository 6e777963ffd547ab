// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Surface and edge contributions of a target at rest for pairs of directions. Every transmit direction is traced once,
// whatever the number of receivers, and so is every other receive direction, whose waves find the exit paths of edges.

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/edges/edge_contribution.h"
#include "sim/scattering/response/illumination.h"
#include "sim/scattering/surfaces/footprint.h"

namespace seaglint {

// Receives the contributions of a pair chunk by chunk, those of a chunk in order from one thread.
struct AspectVisitor {
  std::function<void(std::size_t pair, std::size_t chunk, std::span<const Footprint>)> surfaces;
  std::function<void(std::size_t pair, std::size_t chunk, std::span<const EdgeContribution>)> edges;
};

class AspectTrace {
 public:
  // `wavenumbers`: those at which materials are evaluated and what is faint is left out, at least one. All arguments
  // must outlive it.
  AspectTrace(const Scatterer& scatterer, std::span<const BistaticGeometry> pairs, const TracingSettings& settings,
              std::span<const double> wavenumbers, int threads);

  // Chunks of a pair; they do not depend on the number of threads.
  std::size_t chunk_count(std::size_t pair) const;

  // Returns the legs of beams that left the transmitters. Throws Interrupted when *stop becomes true.
  std::size_t run(const AspectVisitor& visit, const StopFlag* stop = nullptr) const;

 private:
  // One transmit direction and the pairs that have it.
  struct Transmitter {
    std::size_t direction;           // of directions_
    std::vector<std::size_t> pairs;  // in the order of the illumination's receivers
    Illumination illumination;
  };

  const Scatterer& scatterer_;
  std::span<const BistaticGeometry> pairs_;
  const TracingSettings& settings_;
  std::span<const double> wavenumbers_;
  int threads_;
  std::vector<std::shared_ptr<const Aspect>> directions_;  // without repetition
  std::vector<std::size_t> transmit_, receive_;            // directions of each pair
  std::vector<Transmitter> transmitters_;
};

}  // namespace seaglint

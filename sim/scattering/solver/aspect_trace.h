// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Surface and edge contributions of a target at rest for pairs of transmit and receive directions. Each transmit
// direction is traced once for all its receivers; each receive direction that is not a transmit direction is traced
// once for the exit paths of edges. Over the sea two traces and two visible surfaces serve all four propagation paths.

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/radiation/edge_contribution.h"
#include "sim/scattering/radiation/footprint.h"
#include "sim/scattering/solver/illumination.h"

namespace seaglint {

// Receives the contributions of a pair by chunk; those of a chunk arrive in order from one thread. `complete` may be
// empty; it is called once per chunk, from any thread, after the chunk's last contribution.
struct AspectVisitor {
  std::function<void(std::size_t pair, std::size_t chunk, std::span<const Footprint>)> surfaces;
  std::function<void(std::size_t pair, std::size_t chunk, std::span<const EdgeContribution>)> edges;
  std::function<void(std::size_t pair, std::size_t chunk)> complete = {};
};

class AspectTrace {
 public:
  // `wavenumbers`: at which materials are evaluated and weak contributions are omitted, at least one. All arguments
  // must outlive the object.
  AspectTrace(const Scatterer& scatterer, std::span<const BistaticGeometry> pairs, const TracingSettings& settings,
              std::span<const double> wavenumbers, int threads);

  // Number of chunks of a pair, independent of the number of threads.
  std::size_t chunk_count(std::size_t pair) const;

  // Returns the number of beam segments traced from the transmit directions. Throws Interrupted when *stop becomes
  // true.
  std::size_t run(const AspectVisitor& visit, const StopFlag* stop = nullptr) const;

 private:
  // One transmit direction and the pairs that share it.
  struct Transmitter {
    std::size_t direction;           // index into directions_
    std::vector<std::size_t> pairs;  // in the order of the illumination's receivers
    Illumination illumination;
  };

  const Scatterer& scatterer_;
  std::span<const BistaticGeometry> pairs_;
  const TracingSettings& settings_;
  std::span<const double> wavenumbers_;
  int threads_;
  std::vector<std::shared_ptr<const Aspect>> directions_;  // distinct
  std::vector<std::size_t> transmit_, receive_;            // indices into directions_, per pair
  std::vector<Transmitter> transmitters_;
};

}  // namespace seaglint

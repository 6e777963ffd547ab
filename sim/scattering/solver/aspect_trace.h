// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// All contributions of a target at rest for pairs of transmit and receive directions. Each transmit direction is traced
// once for all its receivers; each receive direction that is not a transmit direction is traced once for the exit paths
// of edges. Over the sea two traces and two visible surfaces serve all four propagation paths.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/radiation/lens_reflection.h"
#include "sim/scattering/tracing/edge_illumination.h"
#include "sim/scattering/tracing/transmitted_wave.h"

namespace seaglint {

// One transmit direction and any number of receive directions; a null receiver is the transmitter's antenna.
struct Aspects {
  std::shared_ptr<const Aspect> transmitter;
  std::vector<std::shared_ptr<const Aspect>> receivers;
};

// Illumination of a target from one direction: contributions of all beams, and the edges that they illuminate.
class Illumination {
 public:
  // `wavenumbers`: at which materials are evaluated and weak boundary terms are omitted. May be empty for perfect
  // conductors; nothing is omitted then.
  Illumination(const Scatterer& scatterer, Aspects aspects, const TracingSettings& settings,
               std::span<const double> wavenumbers = {});

  // Edge illuminations, and the number of beam segments traced.
  struct Summary {
    IlluminationByEdge edge_illuminations;
    std::size_t segments = 0;
  };

  // visit(chunk, receiver, contributions) receives the contributions of each chunk part by part of the transmitted
  // wave, in order and from one thread, without those that the filter of the settings rejects and without boundary
  // terms that are negligible at the wavenumbers. `complete`, unless empty, is called after the last ones of a chunk.
  // Chunks do not depend on the number of threads. Throws Interrupted when *stop becomes true.
  std::size_t chunk_count() const;
  using Visit = std::function<void(std::size_t chunk, std::size_t receiver, std::span<const Contribution>)>;
  Summary trace(int threads, const Visit& visit, const StopFlag* stop = nullptr,
                const std::function<void(std::size_t chunk)>& complete = {}) const;

 private:
  std::size_t parts_per_chunk() const;

  const Scatterer& scatterer_;
  TracingSettings settings_;
  Aspects aspects_;
  std::vector<Receiver> receivers_;
  std::unique_ptr<const TransmittedWave> wave_;
  std::vector<std::vector<MaterialSurface>> surfaces_;  // [material][wavenumber]; empty for a perfect conductor
  double lowest_ = 0, highest_ = 0;                     // of the wavenumbers; 0: none given
};

// Which pairs receive the contributions of a pair, as PathSense says.
enum class Reciprocity {
  kNone,        // the pair alone, one way
  kOneAntenna,  // pairs of one antenna the mean of both senses
  kAllPairs,    // also two pairs with exchanged antennas, each with half of its own and half of the other's
};

// Contributions of the pair `source` to the pair `pair`, as they are observed by its antennas.
struct PairContributions {
  std::size_t source, pair, chunk;
  PathSense sense;
  double weight;
  std::span<const Contribution> contributions;

  // The observation of the source pair, for these contributions.
  Observation observed(Observation of_source) const {
    of_source.sense = sense;
    of_source.weight = weight;
    return of_source;
  }
};

class AspectTrace {
 public:
  // `wavenumbers`: at which materials are evaluated and weak contributions are omitted, at least one. All arguments
  // must outlive the object.
  AspectTrace(const Scatterer& scatterer, std::span<const BistaticGeometry> pairs, const TracingSettings& settings,
              std::span<const double> wavenumbers, Reciprocity reciprocity, int threads);

  // Number of chunks of a pair, independent of the number of threads.
  std::size_t chunk_count(std::size_t pair) const;

  // The contributions of a chunk arrive in order from one thread. `complete`, unless empty, is called once per chunk,
  // from any thread, after its last contribution. Returns the number of beam segments traced from the transmit
  // directions. Throws Interrupted when *stop becomes true.
  using Visit = std::function<void(const PairContributions&)>;
  using Complete = std::function<void(std::size_t pair, std::size_t chunk)>;
  std::size_t run(const Visit& visit, const Complete& complete = {}, const StopFlag* stop = nullptr) const;

 private:
  // One transmit direction and the pairs that share it.
  struct Transmitter {
    std::size_t direction;           // index into directions_
    std::vector<std::size_t> pairs;  // in the order of the illumination's receivers
    Illumination illumination;
  };
  std::size_t own_chunks(std::size_t pair) const;
  void pass_on(std::size_t source, std::size_t chunk, std::span<const Contribution> contributions,
               const Visit& visit) const;
  void pass_complete(std::size_t source, std::size_t chunk, const Complete& complete) const;

  const Scatterer& scatterer_;
  std::span<const BistaticGeometry> pairs_;
  const TracingSettings& settings_;
  std::span<const double> wavenumbers_;
  Reciprocity reciprocity_;
  int threads_;
  std::vector<std::shared_ptr<const Aspect>> directions_;  // distinct
  std::vector<std::size_t> transmit_, receive_;            // indices into directions_, per pair
  std::vector<std::optional<std::size_t>> exchanged_;      // per pair, the other one that shares contributions
  std::vector<Transmitter> transmitters_;
  std::vector<LuneburgLens> lenses_;
};

}  // namespace seaglint

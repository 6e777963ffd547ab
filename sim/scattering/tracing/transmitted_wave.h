// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Transmitted wave, divided into parts that are traced independently of each other: by beams the panels that it
// illuminates, by rays the tiles of a lattice. Both are bundles of parallel rays of polygonal cross-section.

#include <functional>
#include <memory>

#include "sim/scattering/tracing/interaction.h"

namespace seaglint {

// A look direction and the visible part of every panel.
struct Aspect {
  RadarBasis basis;  // perturbed by 1e-6 rad where faces or edges have only a limit (transmitted_wave.cpp)
  VisibleSurface visible;

  Aspect(const Scatterer& scatterer, const RadarBasis& direction, const TracingSettings& settings, int threads);

 private:
  Aspect(const Scatterer& scatterer, const TracingSettings& settings, int threads, const RadarBasis& perturbed);
};

class TransmittedWave {
 public:
  virtual ~TransmittedWave() = default;
  virtual std::size_t parts() const = 0;
  virtual std::size_t least_parts_per_chunk() const = 0;  // for which a chunk is worth its overhead
  // Traces the parts first <= i < last and returns the number of beam segments. Calls after_each() when a part is
  // complete. Any number of threads may call it.
  virtual std::size_t trace(const TracingContext& scene, std::size_t first, std::size_t last,
                            InteractionVisitor& visitor, const std::function<void()>& after_each) const = 0;
};

// By the method of the settings. The scatterer and the aspect must outlive it.
std::unique_ptr<const TransmittedWave> transmitted_wave(const Scatterer& scatterer, const Aspect& transmitter,
                                                        const TracingSettings& settings);

}  // namespace seaglint

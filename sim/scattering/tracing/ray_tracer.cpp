// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/ray_tracer.h"

#include "sim/scattering/tracing/ray_refinement.h"
#include "sim/scattering/tracing/ray_search.h"

namespace seaglint {

std::size_t trace_rays(const TracingContext& scene, const RayLattice& lattice, std::size_t first, std::size_t last,
                       InteractionVisitor& visitor, const std::function<void()>& after_each) {
  std::size_t segments = 0;
  RayPaths paths(scene);
  const RaySearch search(scene, paths);
  RayRefinement refinement(lattice, paths);
  for (std::size_t tile = first; tile < last; ++tile) {
    refinement.trace(tile);
    segments += trace_window(scene, search, lattice.window(tile), 0, visitor);
    after_each();
  }
  return segments;
}

}  // namespace seaglint

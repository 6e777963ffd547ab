// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Beam tracing: beams are followed from reflector to reflector, and the illuminated and visible polygons of every panel
// on their path are passed to a visitor (P. S. Heckbert and P. Hanrahan, Proc. SIGGRAPH 1984, 119-127).

#include <functional>
#include <span>

#include "sim/scattering/tracing/interaction.h"

namespace seaglint {

// Traces all beams whose first reflector is the panel of one of these facets (its first facet) and returns the number
// of segments behind it. The scene must have the surface visible to the transmitter. Calls after_each() when the beams
// of one facet are complete.
std::size_t trace_beams(
    const TracingContext& scene, const PanelSearch& search, std::span<const int> facets, InteractionVisitor& visitor,
    const std::function<void()>& after_each = [] {});

// Traces the transmitted wave within a window of the projection plane and all that it illuminates; returns the number
// of segments. `path`: of the transmitted wave, as FoundPanel::path.
std::size_t trace_window(const TracingContext& scene, const PanelSearch& search, const PolygonSet& window, int path,
                         InteractionVisitor& visitor);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Shooting and bouncing rays: rays find the reflectors and obstacles of every tile of a lattice, and tubes of rays with
// equal sequences illuminate them (H. Ling, R.-C. Chou and S.-W. Lee, IEEE Trans. AP-37, 1989, 194-205).

#include <cstddef>
#include <functional>

#include "sim/scattering/tracing/beam_tracer.h"
#include "sim/scattering/tracing/ray_lattice.h"

namespace seaglint {

// Traces the tiles first <= i < last of the lattice, whose projection plane is that of the scene's transmitter, and
// returns the number of segments of tubes. Calls after_each() when the tubes of one tile are complete.
std::size_t trace_rays(
    const TracingContext& scene, const RayLattice& lattice, std::size_t first, std::size_t last, InteractionVisitor& visitor,
    const std::function<void()>& after_each = [] {});

}  // namespace seaglint

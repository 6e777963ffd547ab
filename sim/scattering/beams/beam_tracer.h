// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Follows beams from mirror to mirror and writes down what they light. Illumination is the way in.

#include <functional>
#include <span>

#include "sim/scattering/beams/tracing_context.h"

namespace seaglint {

// Appends what all beams light whose first mirror is the panel of one of these facets; returns the legs followed. Calls
// after_each() when the beams of one are followed.
std::size_t trace_beams(
    const BeamScene& scene, std::span<const int> facets, Lit& out, const std::function<void()>& after_each = [] {});

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Selection of contributions by part, bounce count and mechanism.

#include <array>
#include <string>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

// Names of the mechanisms in tables and selections, in the order of Mechanism. In selections `edge` is all but `po`.
inline constexpr std::array<const char*, kMechanisms> kMechanismNames{
    "po", "single", "multiple", "reflected_edge", "shadow_boundary", "penumbra", "concave"};

// Filter of a selection. Throws InputError for an invalid entry and for a selection that no contribution can satisfy
// with the given bounce limit and edge diffraction.
ContributionFilter filter_of(const EchoSelection& selection, const TriangleMesh& mesh, int max_bounces, bool edges);

// Text of the selection as given, for the head of a table; "everything" if there is none.
std::string text_of(const EchoSelection& selection);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Echoes selected by part, bounces and mechanism.

#include <string>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/beams/contribution_filter.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

inline constexpr const char* kMechanismNames[] = {"po", "edge"};

// Throws InputError, also for a selection that nothing can meet: with so many bounces followed, with edges or without.
ContributionFilter filter_of(const EchoSelection& selection, const TriangleMesh& mesh, int max_bounces, bool edges);

// The selection as it was given, for the head of a table; "everything" without one.
std::string text_of(const EchoSelection& selection);

}  // namespace seaglint

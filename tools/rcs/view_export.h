// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Exports of the contributions at one aspect and frequency: scattering centres, hot spots on the mesh.

#include <span>
#include <string>

#include "sim/scattering/points/decomposition.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"

namespace seaglint {

// Writes the exports of a request with one aspect from the contributions at that aspect (rcs_views.h); returns one line
// per file.
std::string export_view(const RcsRequest& request, const RcsTarget& target, std::span<const Point> points);

}  // namespace seaglint

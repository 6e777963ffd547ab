// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Exports of the contributions at one aspect and frequency: scattering centres, hot spots on the mesh.

#include <string>

#include "sim/core/process/parallel.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"

namespace seaglint {

// Writes the exports of a request with one aspect; returns one line per file. Throws Interrupted when *stop becomes
// true.
std::string export_view(const RcsRequest& request, const RcsTarget& target, int threads,
                        const StopFlag* stop = nullptr);

}  // namespace seaglint

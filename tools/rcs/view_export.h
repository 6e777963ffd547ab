// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What one view at one frequency consists of: scattering centres, hot spots on the mesh.

#include <string>

#include "sim/core/process/parallel.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"

namespace seaglint {

// Writes the exports that the request of one view wants; returns one line for each file. Throws Interrupted when *stop
// becomes true.
std::string export_view(const RcsRequest& request, const RcsTarget& target, int threads,
                        const StopFlag* stop = nullptr);

}  // namespace seaglint

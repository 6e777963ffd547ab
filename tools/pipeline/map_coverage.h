// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Parts of a scenario's targets that lie outside its maps.

#include <string>
#include <vector>

#include "tools/pipeline/pipeline.h"

namespace seaglint {

// One line for every target and view whose bodies at rest, with the translations of a recorded motion, points or their
// velocities reach beyond the map's range or velocity span, with the numbers; at most ten lines, then the count of the
// rest. Echoes outside the map are cut off or, beyond the unambiguous span, aliased into it.
std::vector<std::string> map_coverage_warnings(const Pipeline& pipeline);

}  // namespace seaglint

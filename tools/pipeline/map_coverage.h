// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What of a scenario's targets its maps cannot show.

#include <string>
#include <vector>

#include "tools/pipeline/pipeline.h"

namespace seaglint {

// One line for every target and view whose bodies at rest, points or their velocities reach beyond the map's range or
// velocity span, with the numbers; at most ten lines, then how many more. What lies outside is cut off or, beyond the
// unambiguous span, folded in.
std::vector<std::string> map_coverage_warnings(const Pipeline& pipeline);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Whether a target is one that this solver can answer for: its size in wavelengths, its place, and how much work it is.

#include <string>
#include <vector>

#include "sim/geometry/triangle_mesh.h"

namespace seaglint {

// What a user should know before the first trace, one sentence each; empty for most targets. lowest_hz: of the sweep; ray_spacing_m: 0 = the default.
// Throws InputError when the answer would be nothing (the target lies so far from its origin that its polygons fall below the smallest that are kept) or
// would not come (rays for one view beyond 1e8).
std::vector<std::string> check_target(const TriangleMesh& mesh, double lowest_hz, double ray_spacing_m);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Whether a target is one that this solver can answer for: its size in wavelengths, its place, and how much work it is.

#include <string>
#include <vector>

#include "sim/geometry/triangle_mesh.h"

namespace seaglint {

// What a user should know before the first trace, one sentence each; empty for most targets. lowest_hz: of the sweep. Throws InputError when the target lies
// so far from its origin that its details fall below the smallest that are followed.
std::vector<std::string> check_target(const TriangleMesh& mesh, double lowest_hz);

// Throws InputError where a radar at this range (0: far field) stands too near for the second order of the wavefront over a target that reaches
// `radius_m` from its origin: beyond ten radii the third order is below a tenth of it.
void check_range(double radius_m, double range_m);

}  // namespace seaglint

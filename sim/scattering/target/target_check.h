// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Checks of a target against the validity of the solver: electrical size, position and number of triangles.

#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/target/scatterer.h"

namespace seaglint {

// One sentence per warning; empty for most targets. lowest_hz: lowest frequency of the sweep. Throws InputError when
// the target is more than 300 half-sizes from its origin, so that its details are smaller than the smallest patch kept.
std::vector<std::string> check_target(const TriangleMesh& mesh, double lowest_hz);

// One sentence where sharp edges longer than a wavelength bound bars or strips narrower than a third of it on both
// sides: their half-plane currents neglect each other and return too much. One sentence where sheets are thicker than a
// tenth of the shortest wavelength, or where a thickness has no effect: no sheets, or edges not used (`followed`).
std::vector<std::string> check_edges(const Scatterer& scatterer, bool followed, double lowest_hz, double highest_hz);

// Throws InputError where the wavefront range (m; 0: plane wave) is less than ten times the target's radius about its
// origin: beyond that the third-order term of the wavefront is below a tenth of the second-order one.
void check_wavefront_range(double radius_m, double range_m);

}  // namespace seaglint

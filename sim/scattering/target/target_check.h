// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Whether a target is one that this solver can answer for: its size in wavelengths, its place, and how much work it is.

#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/target/scatterer.h"

namespace seaglint {

// What a user should know before the first trace, one sentence each; empty for most targets. lowest_hz: of the sweep.
// Throws InputError when the target lies so far from its origin that its details fall below the smallest that are
// followed.
std::vector<std::string> check_target(const TriangleMesh& mesh, double lowest_hz);

// A sentence where sharp edges longer than a wavelength bound bars and strips narrower than a third of it on every
// side: the edges' currents are those of half-planes that do not know of each other, and return too much. Another where
// sheets are thicker than a tenth of the shortest wavelength, or have a thickness that changes nothing: there are none,
// or edges are not followed.
std::vector<std::string> check_edges(const Scatterer& scatterer, bool followed, double lowest_hz, double highest_hz);

// Throws InputError where a radar at this range (0: far field) stands too near for the second order of the wavefront
// over a target that reaches `radius_m` from its origin: beyond ten radii the third order is below a tenth of it.
void check_wavefront_range(double radius_m, double range_m);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Checks of a target against the validity of the solver: electrical size, position, number of triangles, edges and
// bars.

#include <span>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/scatterer/scatterer.h"

namespace seaglint {

// One sentence per warning; empty for most targets. lowest_hz: lowest frequency of the sweep. Throws InputError when
// the target is more than 300 half-sizes from its origin, so that its details are smaller than the smallest patch kept.
std::vector<std::string> check_target(const TriangleMesh& mesh, double lowest_hz);

// One sentence where sharp edges longer than a wavelength bound bars or strips narrower than a third of it on both
// sides: their half-plane currents neglect each other and return too much. One sentence where sheets are thicker than a
// tenth of the shortest wavelength, or where a thickness has no effect: no sheets, or edges not used (`followed`). One
// sentence where edges of materials longer than a wavelength do not diffract. Sentences name the part with the greatest
// length of such edges.
std::vector<std::string> check_edges(const Scatterer& scatterer, bool followed, double lowest_hz, double highest_hz,
                                     std::span<const std::string> part_names = {});

// One sentence, with the part that has the greatest length of them, where surfaces longer than a wavelength are round
// bars thinner than 0.7 of it. Backscatter of the circular cylinder by physical optics less the exact series, normal
// incidence, largest of both polarisations at diameters of 0.1, 0.2, 0.33, 0.5, 0.7 and 1 wavelengths: 7.0, 2.6,
// 0.6, 2.9, 0.4, 0.6 dB.
std::vector<std::string> check_bars(const Scatterer& scatterer, double lowest_hz,
                                    std::span<const std::string> part_names = {});

}  // namespace seaglint

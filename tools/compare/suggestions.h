// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What two curves that differ may have different: time factor, signs, origin, unit, scale of the levels, the sense and
// the zero of the azimuth, the size of the mesh.

#include <optional>
#include <string>
#include <vector>

#include "tools/compare/alignment.h"
#include "tools/rcs/paired_cut.h"

namespace seaglint {

// A sentence for each that fits clearly better than none. Cuts with one model each; levels are clipped at floor_db
// below each reference's maximum.
std::vector<std::string> suggestions(const std::vector<PairedCut>& cuts, const std::optional<Alignment>& alignment,
                                     double floor_db);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a map has outside of its target: clutter, noise, and what the processing leaks into them (range side lobes of
// the hop pedestal). Where it separates targets of equal geometry, the data set has a leak.

#include <vector>

#include "classify/dataset/format/sample.h"

namespace seaglint {

inline constexpr double kBlankedMarginM = 6;                  // beyond the outermost centres
inline constexpr int kBlankedDistances = 4;                   // bands of the distance from the blanked ranges
inline constexpr int kBlankedVelocities = 8;                  // bands of the velocity, equal numbers of cells
inline constexpr double kBlankedDistancesM[] = {10, 25, 50};  // their limits; the last band has the rest of the map

// Mean power of bands of the cells whose ranges are outside of [first centre - margin, last centre + margin], dB above
// the mean of all these cells: [distance][velocity], kBlankedDistances kBlankedVelocities values. 0 where a band has no
// cell, and everywhere when no range is left or the rest has no power. The level itself, which is the signal-to-clutter
// ratio, is left out (other probes have it).
std::vector<double> blanked_levels_db(const Sample& sample, const StoredAxes& axes);

}  // namespace seaglint

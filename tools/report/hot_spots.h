// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The targets of a report in three dimensions, coloured by the contributions of their facets, as hot_spots.js draws
// them.

#include <cstddef>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tools/pipeline/scene.h"

namespace seaglint {

inline constexpr std::size_t kHotSpotViews = 24;       // of a target, at most
inline constexpr std::size_t kHotSpotFacets = 60'000;  // of all targets that are drawn: about 0.9 MB of page

struct HotSpots {
  std::string json;   // empty: no target to draw
  std::string about;  // sentences for the page, HTML
};

// Levels of each target's facets (facet_levels.h) at the middle of the band in the radar's polarisation, for one body
// at rest without the sea: whole dB, down to 50 dB below the target's strongest facet over all views. Views are those
// of the scenario, by azimuth, then elevation; of more than kHotSpotViews every n-th. Targets beyond kHotSpotFacets are
// left out, which `about` states. The result is the same for any number of threads. Throws Interrupted when *stop
// becomes true.
HotSpots hot_spots(const Scenario& scenario, const SamplePlan& plan, const std::vector<Target>& targets, int threads,
                   const StopFlag* stop);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a sweep shows at first sight: levels over its angle or frequency as a figure, their percentiles and largest
// values as text.

#include <string>
#include <vector>

#include "tools/figure/figure.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

// Of one co-polar element along the azimuths of one elevation and frequency; levels in dBsm, percentiles over the
// values as they are given.
struct LevelStatistics {
  std::size_t element = 0;  // of kCoPolar
  double frequency_hz = 0, elevation_deg = 0;
  double lowest_tenth_dbsm = 0, median_dbsm = 0, highest_tenth_dbsm = 0;  // 10, 50 and 90 %
  double mean_dbsm = 0;                                                   // of the area, not of the level
  double largest_dbsm = 0, largest_azimuth_deg = 0;
};

// hh and vv of every elevation and frequency; empty for a sweep of less than kFewestDrawn azimuths.
std::vector<LevelStatistics> level_statistics(const RcsSweep& sweep);

// A table of the first eight, a line each below a heading, and how many more there are; empty without any.
std::string statistics_text(const std::vector<LevelStatistics>& statistics);

inline constexpr std::size_t kFewestDrawn = 8;
inline constexpr double kMedianWindow_deg = 10;

// Phrases of the small print below every figure of a request: band, aspect, antennas, contributions and sea where they
// are not the usual ones, solver, version.
std::vector<std::string> sweep_notes(const RcsRequest& request);
// Of the solver and what follows it alone.
std::vector<std::string> solver_notes(const RcsRequest& request);

// hh and vv of the last model over the longest axis of the sweep (azimuth, else frequency, else elevation), a panel for
// each of at most four other values, evenly chosen; over azimuths of a sector of four windows and more also their
// medians in a window of kMedianWindow_deg. No panels below kFewestDrawn values. Polar:
// over azimuth about the target, else none.
PlotPanels level_plots(const RcsSweep& sweep, bool polar = false);

}  // namespace seaglint

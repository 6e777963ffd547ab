// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Arbitrary sets of frequencies and directions as few grids, which a sweep solves at once.

#include <compare>
#include <span>
#include <vector>

namespace seaglint {

struct ViewPoint {
  double frequency_hz = 0, azimuth_deg = 0, elevation_deg = 0;
  auto operator<=>(const ViewPoint&) const = default;  // NOLINT(modernize-use-nullptr): compares with 0
};

// All combinations of these values.
struct ViewGrid {
  std::vector<double> frequency_hz, azimuth_deg, elevation_deg;  // ascending
  bool operator==(const ViewGrid&) const = default;
};

// Grids that hold every point exactly once and nothing else: directions of equal frequencies, then elevations of equal
// azimuths. Points that stand repeatedly count once.
std::vector<ViewGrid> view_grids(std::span<const ViewPoint> points);

// The grid cut along its longest side, so that one variable changes in each: frequencies of each direction, or
// directions of one elevation or azimuth at all frequencies.
std::vector<ViewGrid> cuts_of(const ViewGrid& grid);

}  // namespace seaglint

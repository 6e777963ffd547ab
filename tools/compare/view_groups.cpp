// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/view_groups.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace seaglint {

std::vector<ViewGrid> view_grids(std::span<const ViewPoint> points) {
  using Direction = std::pair<double, double>;  // elevation, azimuth
  std::map<Direction, std::vector<double>> frequencies;
  std::vector<ViewPoint> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (const ViewPoint& p : sorted) frequencies[{p.elevation_deg, p.azimuth_deg}].push_back(p.frequency_hz);

  std::map<std::vector<double>, std::map<double, std::vector<double>>> azimuths;  // by frequencies, then elevation
  for (const auto& [direction, list] : frequencies) azimuths[list][direction.first].push_back(direction.second);

  std::vector<ViewGrid> grids;
  for (const auto& [list, rows] : azimuths) {
    std::map<std::vector<double>, std::vector<double>> elevations;  // by azimuths
    for (const auto& [elevation, row] : rows) elevations[row].push_back(elevation);
    for (const auto& [row, column] : elevations) grids.push_back({list, row, column});
  }
  return grids;
}

std::vector<ViewGrid> cuts_of(const ViewGrid& grid) {
  const std::size_t azimuths = grid.azimuth_deg.size(), elevations = grid.elevation_deg.size();
  const bool along_frequency = grid.frequency_hz.size() > std::max(azimuths, elevations);
  std::vector<ViewGrid> cuts;
  const auto add = [&](const std::vector<double>& azimuth_deg, const std::vector<double>& elevation_deg) {
    cuts.push_back({grid.frequency_hz, azimuth_deg, elevation_deg});
  };
  if (along_frequency) {
    for (const double el : grid.elevation_deg) {
      for (const double az : grid.azimuth_deg) add({az}, {el});
    }
  } else if (azimuths >= elevations) {
    for (const double el : grid.elevation_deg) add(grid.azimuth_deg, {el});
  } else {
    for (const double az : grid.azimuth_deg) add({az}, grid.elevation_deg);
  }
  return cuts;
}

}  // namespace seaglint

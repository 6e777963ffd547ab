// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Samples and maps as report.js reads them: the columns of all samples, and as many maps as the page has room for.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "classify/dataset/format/sample.h"
#include "classify/model/data_rows.h"

namespace seaglint {

inline constexpr double kMapFloorDb = -45;                   // of a map, relative to its strongest cell
inline constexpr std::size_t kExplorerBytes = 820'000;       // of all packed maps with their centres
inline constexpr std::size_t kExplorerCells[2] = {64, 128};  // velocity, range; larger maps are reduced to these

// A map reduced to whole decibels.
struct ExplorerMap {
  std::int64_t sample = 0;
  std::string packed;                 // one byte a cell, 0 = kMapFloorDb or below, [velocity][range] (plot_json.h)
  std::vector<StoredCentre> centres;  // third member in dB relative to the strongest cell
};

// Axis of reduced maps.
struct ReducedAxis {
  double first = 0;  // centre of the first cell
  double step = 0;
  std::size_t count = 0;
  std::size_t cells = 1;  // of the map in each cell
};
ReducedAxis reduced_axis(std::span<const double> cells, std::size_t at_most);

// The largest value of each group of cells, in dB relative to the strongest, rounded to 1 dB.
ExplorerMap explorer_map(const Sample& sample, const StoredAxes& axes);

// Samples in the order in which maps are kept: the first map of every target, view and sea state in every bin of wave
// height and azimuth, then the second.
std::vector<std::size_t> explorer_order(std::span<const SampleRecord> records, std::span<const ColumnBin> heights,
                                        std::span<const ColumnBin> azimuths);

// What the page shows: all samples, some of their maps, and the states that a user chooses from.
struct ExplorerData {
  std::span<const SampleRecord> records;
  std::span<const ExplorerMap>
      maps;  // of any of the records; those beyond kExplorerBytes in explorer_order are left out
  const StoredAxes& axes;
  std::span<const ColumnBin> heights, azimuths;  // bins of the records by wave height and azimuth
  std::size_t height = 0, azimuth = 0;           // those shown first
};

// JSON of report.js.
std::string explorer_json(const ExplorerData& data);

}  // namespace seaglint

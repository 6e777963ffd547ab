// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a report shows by scripts: samples and maps as report.js reads them, targets in three dimensions as hot_spots.js
// draws them.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "classify/dataset/format/sample.h"
#include "classify/model/data_rows.h"
#include "sim/core/process/parallel.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tools/figure/map_figure.h"
#include "tools/pipeline/scene.h"

namespace seaglint {

// Samples and maps as report.js reads them: the columns of all samples, and as many maps as the page has room for.

inline constexpr std::size_t kExplorerBytes = 820'000;       // of all packed maps with their centres
inline constexpr std::size_t kExplorerCells[2] = {64, 128};  // velocity, range; larger maps are reduced to these

// A map reduced to whole decibels.
struct ExplorerMap {
  std::int64_t sample = 0;
  std::string packed;                 // one byte a cell, 0 = kMapFloorDb or below, [velocity][range] (packed())
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

// The targets of a report in three dimensions, coloured by the contributions of their facets, as hot_spots.js draws
// them.

inline constexpr std::size_t kHotSpotViews = 24;       // of a target, at most
inline constexpr std::size_t kHotSpotFacets = 60'000;  // of all targets that are drawn: about 0.9 MB of page

struct HotSpots {
  std::string json;   // empty: no target to draw
  std::string about;  // sentences for the page, HTML
};

// Levels of each target's facets (facet_levels()) at the middle of the band in the radar's polarisation, for one body
// at rest without the sea: whole dB, down to 50 dB below the target's strongest facet over all views; the 100 strongest
// scattering centres of each view. Views are those
// of the scenario, by azimuth, then elevation; of more than kHotSpotViews every n-th. Targets beyond kHotSpotFacets are
// left out, which `about` states. The result is the same for any number of threads. Throws Interrupted when *stop
// becomes true.
HotSpots hot_spots(const Scenario& scenario, const SamplePlan& plan, const std::vector<Target>& targets, int threads,
                   const StopFlag* stop);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Some of a data set's stored maps side by side, the same seas and aspects of every class, without the solver.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "sim/core/process/parallel.h"
#include "tools/figure/map_figure.h"

namespace seaglint {

// At most `count` of the points of a grid, one size of at least 1 for each axis, as coordinates: each next one has
// coordinates that the earlier ones have least often, and is as far from them as possible (the grid as a unit cube).
std::vector<std::vector<std::size_t>> spread_points(std::span<const std::size_t> sizes, std::size_t count);

struct ContactSheetRequest {
  const DatasetReader& reader;
  std::size_t samples = 12;  // at most; in equal numbers of every class, which all have the same seas and views
  bool whole = false;        // whole maps; else the window of all targets that are shown, see target_window()
  FigureStyle style = FigureStyle::kScreen;
  const StopFlag* stop = nullptr;
};

struct ContactSheet {
  HeatmapPanels figure;
  std::string text;  // a line for each map: sample, class, target, sea, aspect, SCR
};

// Every shard that is read is compared with the manifest first. Throws InputError naming a damaged shard or one of
// another format, and the errors of read_scenario(); Interrupted when *stop becomes true.
ContactSheet contact_sheet(const ContactSheetRequest& request);

}  // namespace seaglint

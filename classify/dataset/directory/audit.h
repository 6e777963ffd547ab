// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Is a data set what its manifest and its rows say? Everything that can be told without making maps again.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

struct Audit {
  std::size_t shards = 0, samples = 0, groups = 0;  // sound ones that were read
  std::vector<std::size_t> per_target;              // samples of each target
  std::vector<std::string> faults;  // file, sample and column each, with what is there and what should be
  Scenario scenario;                // as the directory keeps it
};

// Reads all shards. Faults are
// - shards that are missing, damaged, foreign or left half-written, and other files that do not belong there;
// - samples that are missing, repeated (by number or by map) or out of order;
// - rows that contradict the scenario: label, target, sea, view, interval, keys, group;
// - maps with values that are no magnitudes, or whose peak and energy are not those of the row;
// - hop codes beyond the scenario's carriers; axes that differ between shards;
// - a merged file beside the shards that is damaged, of another manifest or not what the shards hold;
// - a sea realisation in two groups or two in one, by which a split would leak.
// Throws InputError when manifest or scenario cannot be read, Interrupted when *stop becomes true.
Audit audit(const std::filesystem::path& directory, const StopFlag* stop = nullptr);

}  // namespace seaglint

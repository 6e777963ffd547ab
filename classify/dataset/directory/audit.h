// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Audit of a data set against its manifest and scenario: every check that needs no regenerated map.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

struct Audit {
  Scenario scenario;                                // as stored in the directory
  SamplePlan plan;                                  // of the scenario
  std::size_t shards = 0, samples = 0, groups = 0;  // valid ones that were read
  std::vector<std::size_t> per_target;              // samples of each target
  std::vector<std::string> faults;  // each names file, sample and column, with the stored and the expected value

  explicit Audit(Scenario stored) : scenario(std::move(stored)), plan(scenario), per_target(scenario.targets.size()) {}
};

// Reads all shards. Faults are
// - shards that are missing, damaged, of another data set or left incomplete, and files that do not belong to a data
// set;
// - samples that are missing, repeated (by number or by map) or out of order;
// - rows that contradict the scenario: label, target, sea, view, interval, keys, group;
// - a manifest whose seed, scenario, shard names, version or processors are not the scenario's or the shards';
// - maps with negative or non-finite values, or whose peak or energy differs from that of the row; complex values of
//   other magnitude; columns and scattering centres that are not finite;
// - hop codes beyond the scenario's carriers; axes that differ between shards;
// - a merged file in the directory that is damaged, of another manifest or different from the shards;
// - a sea realisation in two groups or two in one group: splits by group would leak.
// Throws InputError when manifest or scenario cannot be read, Interrupted when *stop becomes true.
Audit audit(const std::filesystem::path& directory, const StopFlag* stop = nullptr);

}  // namespace seaglint

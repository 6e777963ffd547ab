// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a scenario makes: seas, cases and maps, what varies, what moves, and the work of making it.

#include <string>

#include "tools/pipeline/constant_keys.h"

namespace seaglint {

// Work and size of a data set.
struct WorkEstimate {
  double processor_s = 0;
  bool is_bound = false;  // the work is larger: the limit left no time for a map of every target
  double bytes = 0;
  std::string failure;  // why a map cannot be made, as `generate` would refuse it; processor_s is then 0
};

// The work scaled from one or a few maps of every target at the scenario's own settings, and the size of the shards of
// `generate` from the sizes of their arrays.
WorkEstimate estimate_work(const Pipeline& pipeline, const TrialLimit& limit = {});

// Size of the shards, bytes.
double stored_bytes(const Pipeline& pipeline);

// Lines "seas ...", "swept ...", "drawn ...", "moves ..." and "work ...", the last on this number of threads; without
// the time if a map cannot be made.
std::string scenario_summary(const Pipeline& pipeline, const WorkEstimate& work, int threads);

}  // namespace seaglint

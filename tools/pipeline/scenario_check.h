// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a scenario makes: seas, cases and maps, what varies and what moves, the processor time of making it, and swept
// or drawn keys that change nothing.

#include <limits>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/keys.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

// Swept and drawn keys of a scenario that change nothing in its maps. They are found by making maps: two maps that
// differ in the value of one key alone are compared.

// What a key changes. Maps of a small number of pulses are compared with the other keys at the middles of their values,
// then at their ends, one at a time and all together; what is equal in all of them is compared in whole maps, by the
// scenario's own solver settings.
struct KeyEffect {
  VariedKey key;  // refers to the pipeline's scenario
  bool tested = false;
  // Targets of which all maps without clutter and noise are equal within 1e-9 of their largest value, as indices into
  // scenario.targets. For a key of `targets` all or none; for one of `clutter` all.
  std::vector<int> same_targets;
  bool changes_clutter = false;  // clutter or noise of any of them
};

// Limit of the processor time of trial maps, s, and a flag that interrupts them.
struct TrialLimit {
  double processor_s = std::numeric_limits<double>::infinity();
  const StopFlag* stop = nullptr;
};
inline constexpr double kTrialSeconds = 20;

// The effects of varied_keys(), in their order. Keys that the limit leaves no time for, and those whose values
// contradict all others, are not tested. Throws Interrupted when *limit.stop becomes true.
std::vector<KeyEffect> key_effects(const Pipeline& pipeline, const TrialLimit& limit = {});

// One line per key that changes nothing, clutter and noise alone, or nothing in the echo of some targets, with the
// reason where it follows from the scenario; one line for the keys that are not tested.
std::vector<std::string> constant_key_warnings(const Pipeline& pipeline, const TrialLimit& limit = {});

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

// Lines "seas ...", "swept ...", "drawn ...", "moves ...", "clutter ..." and "work ...", the last on this number of
// threads; without the time if a map cannot be made.
std::string scenario_summary(const Pipeline& pipeline, const WorkEstimate& work, int threads);

}  // namespace seaglint

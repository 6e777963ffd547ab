// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Swept and drawn keys of a scenario that change nothing in its maps. They are found by making maps: two maps that
// differ in the value of one key alone are compared.

#include <limits>
#include <string>
#include <vector>

#include "sim/scenario/varied_keys.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

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

}  // namespace seaglint

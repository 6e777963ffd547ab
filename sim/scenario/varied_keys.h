// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Keys of a scenario with several values: those of sweeps, and those that are drawn from distributions.

#include <string>
#include <vector>

#include "sim/scenario/scenario_spec.h"

namespace seaglint {

struct VariedKey {
  std::string key_path;
  Sweep sweep;                       // of a swept key, in order; empty for a drawn one
  const Variation* drawn = nullptr;  // of a drawn key, an entry of scenario.variations; null for a swept one

  // "0.1, 1, 2", of more than eight values "10 to 170 in 17 values"; "uniform(5, 9), once per sea".
  std::string text() const;

  // Values that a trial compares, as written in a scenario and different from each other: the middle one first, then
  // the ends, of words up to eight.
  std::vector<std::string> trial_values() const;
};

// First the swept keys in the order of the fields, then the drawn ones by their paths.
std::vector<VariedKey> varied_keys(const Scenario& scenario);

}  // namespace seaglint

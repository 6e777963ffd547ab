// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// List of all scenario keys.

#include <string>
#include <string_view>
#include <vector>

namespace seaglint {

struct KeyEntry {
  std::string key;       // "radar.carrier_ghz"; NAME and N stand for a target's name and an index
  std::string standard;  // default; "required"; empty: none
  std::string allowed;   // "within 0.1 and 300"
};

// All keys in the order of the effective scenario, from the list of fields (fields.h).
std::vector<KeyEntry> scenario_keys();

// One line for each key with default and allowed values. `of`: only these keys and sections, each with its meaning on a
// second line ("sea", "targets.ship.motion", "sea.gamma"). Throws InputError, with the nearest key, where there
// is none.
std::string list_keys(std::string_view of = {});

}  // namespace seaglint

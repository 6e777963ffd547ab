// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The keys of a scenario: the list of all with what they mean, as text, JSON and JSON Schema, and those that have
// several values in one scenario.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/scenario.h"

namespace seaglint {

struct KeyEntry {
  std::string key;                // "radar.carrier_ghz"; NAME and N stand for a target's name and an index
  std::string standard;           // default; "required"; empty: none
  std::string allowed;            // "within 0.1 and 300 GHz"
  std::string unit;               // "GHz"; empty: none
  std::string meaning;            // whole sentences
  std::optional<DrawnPer> drawn;  // how often the key may be drawn
};

// All keys in the order of the effective scenario, from the table of fields (fields.h).
std::vector<KeyEntry> scenario_keys();

// One line for each key with default and allowed values. `of`: only this key or section ("sea.gamma", "sea",
// "targets.ship.motion"), or the keys that have this text in their name or meaning, in capitals or not; each with its
// meaning and how often it may be drawn on further lines. Throws InputError, with the nearest key, where there is none.
std::string list_keys(std::string_view of = {});

// The entries of scenario_keys() as a JSON list.
std::string keys_json();

// JSON Schema (draft 7) of a scenario file, for editors: types, bounds, words, units and meanings. It accepts what the
// reader accepts, but for contradictions between keys.
std::string scenario_schema();

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

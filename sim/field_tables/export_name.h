// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the names of exported files say, where the files themselves do not.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/field_tables/field_table.h"

namespace seaglint {

// `farfield (f = 9.5), theta = (0,180,0.1), phi = (0,270,90), HP (1) [pw].txt` (CST): the frequency in its unit or else
// in GHz, the polarisation transmitted (HP phi^, VP theta^), and a sweep of the incident wave, which is that of a
// monostatic cut; single angles are those of the incident wave. `ref_rcs.H.txt` (Austin RCS Benchmark Suite): hh, with
// V vv.
struct NameFacts {
  std::optional<double> frequency_hz;
  std::optional<bool> transmits_v;
  std::optional<Polarisation> element;
  std::optional<DeclaredTransmitter> transmitter;
};
NameFacts facts_of_name(const std::string& name);

// The text after `word =` in a name, where `word` stands by itself and in any case; nullopt without it.
std::optional<std::string_view> value_in_name(std::string_view name, std::string_view word);
// The number at the front of a text; nullopt without one.
std::optional<double> leading_number(std::string_view text);
// Whether the word stands in a name by itself, in any case.
bool has_word(std::string_view name, std::string_view word);
// Hz of `9.5 GHz`, without a unit in GHz; nullopt unless it is a number above 0.
std::optional<double> frequency_in_name(std::string_view text);

// Settings completed by the name's facts; `notes` gets a sentence for each fact that is used.
FieldTableSettings completed(FieldTableSettings settings, const NameFacts& facts, std::vector<std::string>& notes);

}  // namespace seaglint

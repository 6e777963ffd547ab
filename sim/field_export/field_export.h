// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Cuts of a FieldTable as files of other programs. Values are about the cut's own phase origin and in its own
// directions. Every function throws InputError "FORMAT needs ..." for a cut without values, phases or transmitter. FEKO
// and CST need both elements of one transmitted polarisation, at the same directions and frequencies.

#include <span>
#include <string>
#include <vector>

#include "sim/field_tables/field_table.h"

namespace seaglint {

// Both elements of one transmitted polarisation: a block per frequency and direction of a monostatic cut, a block per
// frequency and transmitter where the receivers are all thetas with all phis, else one per receiver. Nine digits. E is
// S in metres, theta^ = -v, phi^ = h; the transmitted wave is along v or h, which the file does not state.
std::string feko_text(std::span<const RcsCut> cuts, bool transmitted_v);

struct NamedFile {
  std::string name;  // of the file, without a folder
  std::string text;
};

// One table per frequency and transmitter: both elements of one transmitted polarisation in dB(m^2), at least -200, and
// degrees, ten digits each, theta fastest. Frequency, incident wave and polarisation stand in the name only, as CST has
// it: `STEM (f = 9.5), theta = (85,85,1), phi = (0,30,10), VP.txt`, ranges where it is monostatic.
std::vector<NamedFile> cst_texts(std::span<const RcsCut> cuts, bool transmitted_v, const std::string& stem);

}  // namespace seaglint

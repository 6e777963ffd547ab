// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Farfield tables of the radar cross section as CST writes them, with more digits.

#include <span>
#include <string>
#include <vector>

#include "sim/field_tables/field_table.h"

namespace seaglint {

struct NamedFile {
  std::string name;  // of the file, without a folder
  std::string text;
};

// One table per frequency and transmitter: both elements of one transmitted polarisation in dB(m^2), at least -200, and
// degrees, ten digits each, theta fastest. Frequency, incident wave and polarisation stand in the name only, as CST has
// it: `STEM (f = 9.5), theta = (85,85,1), phi = (0,30,10), VP.txt`, ranges where it is monostatic. Throws InputError
// (received_pair.h).
std::vector<NamedFile> cst_texts(std::span<const RcsCut> cuts, bool transmitted_v, const std::string& stem);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Far fields as FEKO writes them (.ffe, file format 4).

#include <span>
#include <string>

#include "sim/field_tables/field_table.h"

namespace seaglint {

// Both elements of one transmitted polarisation: a block per frequency and direction of a monostatic cut, a block per
// frequency and transmitter where the receivers are all thetas with all phis, else one per receiver. Nine digits. E is
// S in metres, theta^ = -v, phi^ = h; the transmitted wave is along v or h, which the file does not state. Throws
// InputError (received_pair.h).
std::string feko_text(std::span<const RcsCut> cuts, bool transmitted_v);

}  // namespace seaglint

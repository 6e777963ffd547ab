// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Tables of other programs: what their numbers mean, and where they stand.

#include <filesystem>

#include "sim/core/numbers/linear.h"
#include "sim/motion/ship/rao_table.h"

namespace seaglint {

// A table of VERES (ShipX), .re1, version 4: heading 0 is a head sea, x aft, y to starboard, motions and wave phase at
// the point that the file names. Headings of one side only are mirrored. speed: the table's speed nearest to it is
// taken (m/s). Throws InputError with file and line.
RaoTable read_veres_rao(const std::filesystem::path& file, double speed);

// A table of WAMIT, .4 with periods (IPERIO = 1): heading is the direction of propagation, x forward, y to port,
// lengths in units of `unit_length` (ULEN, m). Rows of zero and infinite period are left out.
// `reference` is where WAMIT's body origin lies in the body's frame (the file does not say).
RaoTable read_wamit_rao(const std::filesystem::path& file, double unit_length, const Vec3& reference = Vec3::Zero());

}  // namespace seaglint

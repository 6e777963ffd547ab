// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Files of response amplitude operators of other programs: formats and conventions.

#include <filesystem>

#include "sim/core/numbers/linear.h"
#include "sim/motion/ship/rao_table.h"

namespace seaglint {

// A table of VERES (ShipX), .re1, version 4: heading 0 is a head sea, x aft, y to starboard, motions and wave phase at
// the point given in the file. Headings of one side only are mirrored. speed (m/s): the table at the nearest speed is
// used. Throws InputError with file and line.
RaoTable read_veres_rao(const std::filesystem::path& file, double speed);

// A table of WAMIT, .4 with periods (IPERIO = 1): heading is the direction of propagation, x forward, y to port,
// lengths in units of `unit_length` (ULEN, m). Rows of zero and infinite period are skipped.
// `reference`: WAMIT's body origin in the body frame, m (not in the file).
RaoTable read_wamit_rao(const std::filesystem::path& file, double unit_length, const Vec3& reference = Vec3::Zero());

}  // namespace seaglint

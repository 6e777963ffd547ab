// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Files of response amplitude operators of other programs: formats and conventions.

#include <filesystem>

#include "sim/core/numbers/linear.h"
#include "sim/motion/ship/rao_table.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// A table of VERES (ShipX), .re1, version 4: heading 0 is a head sea, x aft, y to starboard, motions and wave phase at
// the point given in the file. Headings of one side only are mirrored. speed (m/s): the table at the nearest speed is
// used. `units`: the keys rao_ of a MotionSpec. side_m: longer horizontal side of the body, m (0: unknown). Throws
// InputError with file and line, and where long waves contradict the units (long_waves.h).
RaoTable read_veres_rao(const std::filesystem::path& file, double speed, const MotionSpec& units = {},
                        double side_m = 0);

// A table of WAMIT, .4: x forward, y to port, first column periods (IPERIO = 1) or frequencies in rad/s; rows of zero
// and infinite frequency are skipped. `spec`: the keys rao_ and wamit_ of a MotionSpec. `reference`: WAMIT's body
// origin in the body frame, m (not in the file). side_m as above. Throws InputError with file, line and column, and
// where long waves contradict the conventions or units.
RaoTable read_wamit_rao(const std::filesystem::path& file, const MotionSpec& spec, const Vec3& reference = Vec3::Zero(),
                        double side_m = 0);

}  // namespace seaglint

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
// used. Throws InputError with file and line.
RaoTable read_veres_rao(const std::filesystem::path& file, double speed);

// What a table in the format of WAMIT does not state: the unit of its lengths (ULEN, m) and, where another program
// wrote it, the direction that its headings give and the sign of its time factor.
struct WamitConventions {
  double unit_length = 1;
  HeadingConvention heading = HeadingConvention::kTowards;
  TimeFactor time_factor = TimeFactor::kPlus;
};

// A table of WAMIT, .4 with periods (IPERIO = 1): x forward, y to port. Rows of zero and infinite period are skipped.
// `reference`: WAMIT's body origin in the body frame, m (not in the file). Throws InputError with file, line and
// column, and where long waves contradict the conventions (long_waves.h).
RaoTable read_wamit_rao(const std::filesystem::path& file, const WamitConventions& conventions,
                        const Vec3& reference = Vec3::Zero());

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Files of response amplitude operators of other programs: formats and conventions, and a test of both by the longest
// waves of a table.

#include <filesystem>
#include <optional>
#include <string>

#include "sim/core/numbers/linear.h"
#include "sim/motion/ship/responses.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// A table of VERES (ShipX), .re1, version 4: heading 0 is a head sea, x aft, y to starboard, motions and wave phase at
// the point given in the file. Headings of one side only are mirrored. speed (m/s): the table at the nearest speed is
// used. `units`: the keys rao_ of a MotionSpec. side_m: longer horizontal side of the body, m (0: unknown). Throws
// InputError with file and line, and where long waves contradict the units (long_wave_fault()).
RaoTable read_veres_rao(const std::filesystem::path& file, double speed, const MotionSpec& units = {},
                        double side_m = 0);

// A table of WAMIT, .4: x forward, y to port, first column periods (IPERIO = 1) or frequencies in rad/s; rows of zero
// and infinite frequency are skipped. `spec`: the keys rao_ and wamit_ of a MotionSpec. `reference`: WAMIT's body
// origin in the body frame, m (not in the file). side_m as above. Throws InputError with file, line and column, and
// where long waves contradict the conventions or units.
RaoTable read_wamit_rao(const std::filesystem::path& file, const MotionSpec& spec, const Vec3& reference = Vec3::Zero(),
                        double side_m = 0);

// Responses at the lowest frequency of a table over those of a body that follows the surface of long waves
// (CONVENTIONS.md, "Frames"): heave 1, pitch +jk cos mu, roll -jk sin mu with k = w^2/g. Means over the headings,
// extrapolated to zero frequency from the two lowest ones (linear in w^2). Nullopt where the waves are not long enough:
// - heave: the extrapolation changes it by more than a tenth, or a heading differs from the mean by more than a tenth;
//   unless heave is within a tenth of 1 at every heading;
// - pitch (headings within 70 deg of the axis) and roll (those more than 20 deg off): by more than 0.2 of the limit, or
//   the two frequencies differ by more than 0.15, as near a natural period or in water that is shallow for the waves;
//   or a heading differs from the mean by more than a quarter.
struct LongWaveLimits {
  double period_s = 0;  // of the longest waves
  std::optional<Complex> heave, pitch, roll;
};
LongWaveLimits long_wave_limits(const RaoTable& table);

enum class LongWaves { kTooShort, kAgree, kDisagree };

// The sign of pitch, which is opposite when either the headings or the time factor are opposite to those assumed (not
// both). kTooShort where heave at the lowest frequency differs from 1 by more than a tenth, or pitch is not within 20
// deg of +-90 deg, at any heading within 70 deg of the body's axis.
LongWaves long_waves_of(const RaoTable& table);

// What the long waves say about the units of a table: empty, or a sentence with the period, the response, that of a
// body which follows the waves, and the key that mends it. Refused are
// - a limit of heave that differs from 1 by more than 0.2;
// - limits of pitch and roll beyond a factor of 2: their natural periods and a finite depth change them by up to 1.6,
//   VERES' own roll of S175 tends to 1.2; wrong units change them by 25 (ULEN), 57 (degrees) or 1/k (per slope);
// - a table without heave above 0.1 at any frequency, for waves longer than twice the body (its longer side in m; 0:
//   unknown, any waves).
// `wamit`: the format whose rotations are over ULEN and whose first column may be a period or a frequency.
std::string long_wave_fault(const RaoTable& table, const MotionSpec& spec, double side_m, bool wamit);

}  // namespace seaglint

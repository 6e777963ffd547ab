// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship/long_waves.h"

#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {

LongWaves long_waves_of(const RaoTable& table) {
  const double omega = table.omegas().front(), k = omega * omega / kGravity;
  int agree = 0, disagree = 0;
  for (const double mu : table.headings()) {
    const double along = std::cos(mu);
    if (std::abs(along) < std::cos(radians(70))) continue;
    const MotionRao r = table.at(omega, k, mu);
    if (std::abs(r.heave - 1.0) > 0.1) return LongWaves::kTooShort;
    const Complex slope = r.pitch / along;
    if (std::abs(slope.imag()) < std::cos(radians(20)) * std::abs(slope) || slope == 0.0) return LongWaves::kTooShort;
    ++(slope.imag() > 0 ? agree : disagree);
  }
  if (agree > 0 && disagree == 0) return LongWaves::kAgree;
  return disagree > 0 && agree == 0 ? LongWaves::kDisagree : LongWaves::kTooShort;
}

}  // namespace seaglint

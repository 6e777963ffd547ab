// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Which echoes count: by the part they leave the target from, their number of bounces, and their mechanism.

#include <cstdint>
#include <vector>

#include "sim/scattering/footprint.h"

namespace seaglint {

struct EchoSelector {
  enum class Kind : std::uint8_t { kPart, kBounces, kMechanism } kind = Kind::kPart;
  int value = 0;  // index of the part, number of bounces, or the mechanism's number
};

// Empty: everything counts. `only`: an echo must meet a selector of every kind that is named. `without`: it must meet none.
struct EchoFilter {
  std::vector<EchoSelector> only, without;

  bool keeps(int part, int bounces, Mechanism mechanism) const;
};

}  // namespace seaglint

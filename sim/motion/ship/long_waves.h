// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Conventions of a table of responses, tested by its longest waves.

#include "sim/motion/ship/rao_table.h"

namespace seaglint {

enum class LongWaves { kTooShort, kAgree, kDisagree };

// A body follows the slope of waves much longer than itself: heave tends to 1, pitch to +jk cos mu (CONVENTIONS.md,
// "Frames"). Pitch has the opposite sign when either the headings or the time factor are opposite to those assumed
// (not both). kTooShort where heave at the lowest frequency differs from 1 by more than a tenth, or pitch is not within
// 20 deg of +-90 deg, at any heading within 70 deg of the body's axis.
LongWaves long_waves_of(const RaoTable& table);

}  // namespace seaglint

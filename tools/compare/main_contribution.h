// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What contributes most to the echo of one view.

#include <cstddef>
#include <string>

#include "sim/core/process/parallel.h"
#include "tools/rcs/paired_cut.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"

namespace seaglint {

// The part, number of bounces and mechanism whose contributions have the largest sum in this quantity, with its level:
// "part hull, 2 bounces, po, 12.3 dBsm". Monostatic; empty where nothing contributes, and with cavities.
std::string main_contribution(const RcsRequest& request, const RcsTarget& target, const PairedCut::Place& place,
                              std::size_t quantity, const StopFlag& stop);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sim/scattering/target/scatterer.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_sweep.h"

namespace seaglint {

// CSV of the sweep's last model, frequency slowest, then elevation, then azimuth, after `#` lines with version, target
// and settings.
std::string rcs_table(const RcsRequest& request, const Scatterer& scatterer, const RcsSweep& sweep);

}  // namespace seaglint

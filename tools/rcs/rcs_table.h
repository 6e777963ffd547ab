// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "sim/scattering/scatterer/scatterer.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_sweep.h"

namespace seaglint {

// ", method rays, ray_spacing_m 0.01" for the head of a table; empty for the method of beams.
std::string method_text(const RcsRequest& request, const Scatterer& scatterer);

// The `#` lines of a table that a command made: version, target, settings and the warnings, a sentence each.
std::string rcs_heading(const RcsRequest& request, const Scatterer& scatterer, const std::string& made_by,
                        std::span<const std::string> warnings = {});

// CSV of the sweep's last model, frequency slowest, then elevation, then azimuth, after rcs_heading(). A sweep with a
// flat model has the columns of its uncertainty.
std::string rcs_table(const RcsRequest& request, const Scatterer& scatterer, const RcsSweep& sweep,
                      std::span<const std::string> warnings = {});

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Times of a command that writes a time series.

#include <cstddef>

#include "tools/options/command_options.h"

namespace seaglint {

// Adds --duration-s and --step-s; the present values are the defaults.
void add_time_options(CommandOptions& command, double& duration_s, double& step_s);

// Number of times 0, step, ... up to the duration, including the duration when it is within 1e-9 of a step. Throws
// InputError beyond ten million.
std::size_t uniform_time_count(double duration_s, double step_s);

}  // namespace seaglint

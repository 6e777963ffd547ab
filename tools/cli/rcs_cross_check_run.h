// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tools/cli/command.h"
#include "tools/options/rcs_arguments.h"

namespace seaglint {

// `rcs --cross-check`: prints the sweep's cross-check and writes its table where an output is given.
void run_rcs_cross_check(const RcsArguments& arguments, const CommandContext& context);

}  // namespace seaglint

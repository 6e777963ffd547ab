// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Temporary files (sim/core/process/temporary_file.h) in a data set's directory; a killed process leaves them there.

#include <string>

namespace seaglint {

// True for a temporary file of a shard, a merged or exported file, scenario, input list, data card or manifest.
bool is_temporary(const std::string& name);

}  // namespace seaglint

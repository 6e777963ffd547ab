// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Temporary files `<name>.<host>-<process>.tmp` of write_file (sim/core/process/file.h) in a data set's directory; a
// killed process leaves them there.

#include <filesystem>
#include <string>

namespace seaglint {

// True if <name> is a file of a data set: a shard, a merged or exported file, scenario, data card or manifest.
bool is_temporary(const std::string& name);

// True for a temporary file that is no longer being written: its process on this host has ended, or it is of another
// host and was not modified for a day.
bool is_stale(const std::filesystem::path& file);

}  // namespace seaglint

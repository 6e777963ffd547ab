// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Files that write_file (sim/core/process/file.h) has under `<name>.<host>-<process>.tmp` in a data set's directory
// while it writes them, and that a kill leaves there.

#include <filesystem>
#include <string>

namespace seaglint {

// True where <name> is a file of a data set: a shard, a merged or exported file, scenario, data card or manifest.
bool is_temporary(const std::string& name);

// True for a temporary file that nobody writes any more: its process is dead on this host, or it is of another host and
// nothing was written to it for a day.
bool is_stale(const std::filesystem::path& file);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Files that a scenario or a command line names: found in the folders of sim/core/process/data_folder.h, or refused
// with the file that a misspelt name means.

#include <filesystem>
#include <string>

namespace seaglint {

// Path of the file `name` by search_file(). Throws InputError, beginning with `where`, with all places, and a similar
// name if there is one, when there is none.
std::filesystem::path find_file(const std::string& name, const std::filesystem::path& folder, const std::string& where);

// Path of the file `name` of a command line by search_file() without a folder, then in `below` of data_folder()
// ("scenarios": the file name alone suffices). An absolute name as it is, whether it exists or not. Throws InputError
// "NAME: no such file, ..." as find_file() when there is none.
std::filesystem::path find_input(const std::string& name, const std::string& below = "");

// ": did you mean 'assets/combatant_144m.glb'?" for a file whose own name is the nearest to that of `name`: in the
// folder that `name` states, below `folder` (the working directory if empty), or below assets and scenarios of the
// program's data; as it must be written to be found. Empty when no name is near.
std::string similar_file(const std::string& name, const std::filesystem::path& folder);

}  // namespace seaglint

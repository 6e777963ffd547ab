// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Where files are looked for that a scenario or a command line names: assets, materials and scenarios come with the
// program.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seaglint {

// The data that come with the program: $SEAGLINT_DATA if set; PREFIX/share/seaglint of a program PREFIX/bin/NAME; the
// source tree of a program in its build/NAME. Empty if there are none.
std::filesystem::path data_folder();

// Sets it for a process whose program is another one (Python); before the first search, from one thread.
void set_data_folder(const std::filesystem::path& folder);

// The folders in the order in which a relative name is looked for: `folder` if not empty, the working directory (""),
// data_folder() if not empty.
std::vector<std::filesystem::path> search_folders(const std::filesystem::path& folder);

// The first existing file `name` of these folders; an absolute name as it is. nullopt if there is none. Throws
// the WorkError of is_there().
std::optional<std::filesystem::path> search_file(const std::string& name, const std::filesystem::path& folder);

// "neither in A nor in the working directory nor in B", the places of search_file().
std::string places_text(const std::filesystem::path& folder);

}  // namespace seaglint

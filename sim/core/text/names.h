// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Names that users write: suggestions for misspelt ones; where files are looked for that a scenario or a command line
// names, since assets, materials and scenarios come with the program.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seaglint {

// The nearest of the names by edit distance, ignoring case; nothing when none is within a third of the letters.
std::optional<std::string> nearest(std::string_view misspelt, const std::vector<std::string>& names);

// "did you mean 'pulses'?" for the names that a word means, or "must be one of a, b, c" when none is near: the nearest
// with or without a unit at its end ("bandwidth" and "bandwidth_hz" mean "bandwidth_mhz"), else up to four that begin
// with the word or contain it ("hop" means "hop_count", "hop_step_mhz" or "hop_code").
std::string suggestion(std::string_view misspelt, const std::vector<std::string>& names);

// suggestion() where one or several names are near, else nothing.
std::optional<std::string> near_suggestion(std::string_view misspelt, const std::vector<std::string>& names);

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

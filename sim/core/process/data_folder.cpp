// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/data_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <system_error>

#include "sim/core/process/file.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

fs::path folder_beside_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return {};
  for (const fs::path& folder : {program.parent_path() / "share/seaglint", program.parent_path().parent_path()}) {
    if (fs::is_directory(folder / "assets/materials", error)) return folder;
  }
  return {};
}

fs::path& chosen_folder() {
  static fs::path folder = [] {
    const char* set = std::getenv("SEAGLINT_DATA");
    return set != nullptr && *set != '\0' ? fs::path(set) : folder_beside_program();
  }();
  return folder;
}

}  // namespace

fs::path data_folder() { return chosen_folder(); }

void set_data_folder(const fs::path& folder) { chosen_folder() = folder; }

std::vector<fs::path> search_folders(const fs::path& folder) {
  std::vector<fs::path> folders;
  if (!folder.empty()) folders.push_back(folder);
  folders.emplace_back();
  if (!data_folder().empty()) folders.push_back(data_folder());
  return folders;
}

std::optional<fs::path> search_file(const std::string& name, const fs::path& folder) {
  for (const fs::path& place : search_folders(folder)) {
    if (is_there(place / name)) return place / name;
  }
  return std::nullopt;
}

std::string places_text(const fs::path& folder) {
  std::vector<std::string> places;
  for (const fs::path& place : search_folders(folder))
    places.push_back(place.empty() ? "in the working directory" : "in " + place.string());
  return places.size() == 1 ? "not " + places[0] : fmt::format("neither {}", fmt::join(places, " nor "));
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/named_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <vector>

#include "sim/core/process/data_folder.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/suggestion.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

constexpr int kDepth = 3;
constexpr std::size_t kMostEntries = 5000;  // of a folder and those below it

// Files below `folder`, relative to `base`, in the order of their names; without hidden ones.
void add_files_below(const fs::path& folder, const fs::path& base, int depth, std::vector<fs::path>& files) {
  std::vector<fs::directory_entry> entries;
  std::error_code error;
  for (fs::directory_iterator it(folder.empty() ? "." : folder, error), end; !error && it != end; it.increment(error)) {
    if (entries.size() == kMostEntries) break;
    entries.push_back(*it);
  }
  std::ranges::sort(entries, {}, [](const fs::directory_entry& entry) { return entry.path(); });
  for (const fs::directory_entry& entry : entries) {
    const fs::path name = entry.path().filename();
    if (name.native().starts_with('.') || files.size() >= kMostEntries) continue;
    if (entry.is_regular_file(error)) files.push_back(base / name);
    if (depth > 1 && entry.is_directory(error)) add_files_below(folder / name, base / name, depth - 1, files);
  }
}

// Files that a misspelt name could mean, as they must be written.
std::vector<fs::path> known_files(const fs::path& name, const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::path& place : search_folders(folder))
    add_files_below((place / name).parent_path(), name.parent_path(), 1, files);
  if (name.is_absolute()) return files;
  add_files_below(folder, {}, kDepth, files);
  if (data_folder().empty()) return files;
  for (const char* below : {"assets", "scenarios"}) add_files_below(data_folder() / below, below, kDepth, files);
  return files;
}

}  // namespace

std::string similar_file(const std::string& name, const fs::path& folder) {
  const std::vector<fs::path> files = known_files(name, folder);
  std::vector<std::string> own_names;
  for (const fs::path& file : files) own_names.push_back(file.filename().string());
  const std::optional<std::string> near = nearest(fs::path(name).filename().string(), own_names);
  if (!near) return "";
  const auto found = std::ranges::find(own_names, *near) - own_names.begin();
  return fmt::format(": did you mean '{}'?", files[static_cast<std::size_t>(found)].string());
}

fs::path find_file(const std::string& name, const fs::path& folder, const std::string& where) {
  if (const std::optional<fs::path> file = search_file(name, folder)) return *file;
  const std::string places = fs::path(name).is_absolute() ? "" : ", " + places_text(folder);
  throw InputError(fmt::format("{}: value '{}': no such file{}{}", where, name, places, similar_file(name, folder)));
}

fs::path find_input(const std::string& name, const std::string& below) {
  if (const std::optional<fs::path> file = search_file(name, {})) return *file;
  if (fs::path(name).is_absolute()) return name;
  const fs::path folder = below.empty() || data_folder().empty() ? fs::path() : data_folder() / below;
  if (!folder.empty() && is_there(folder / name)) return folder / name;
  throw InputError(fmt::format("{}: no such file, {}{}{}", name, places_text({}),
                               folder.empty() ? "" : fmt::format(" nor in {}", folder.string()),
                               similar_file(name, {})));
}

}  // namespace seaglint

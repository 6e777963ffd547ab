// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

// Edit distance with transpositions of adjacent characters (Damerau 1964, optimal string alignment), ignoring case.
std::size_t distance(std::string_view one, std::string_view other) {
  const std::string a = lower_case(one), b = lower_case(other);
  std::vector<std::size_t> before_last(b.size() + 1), last = before_last, row = before_last;
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

constexpr std::size_t kLongest = 100;  // longer words get no suggestion

std::size_t near_distance(std::string_view misspelt) { return std::max<std::size_t>(1, misspelt.size() / 3); }

constexpr std::array<std::string_view, 30> kUnitEndings{
    "m",    "mm",  "cm",  "km",  "ft", "in",    "s",  "ms", "us", "ns", "hz",  "khz",   "mhz",   "ghz",   "db",
    "dbsm", "deg", "rad", "mps", "kn", "knots", "kw", "w",  "c",  "k",  "psu", "rad_s", "deg_s", "hours", "min"};

// A name without the unit at its end: "bandwidth" of "bandwidth_mhz", "--frequency" of "--frequency-ghz".
std::string_view without_unit(std::string_view name) {
  for (const std::string_view unit : kUnitEndings) {
    if (name.size() < unit.size() + 2 || distance(name.substr(name.size() - unit.size()), unit) != 0) continue;
    const char before = name[name.size() - unit.size() - 1];
    if (before == '_' || before == '-') return name.substr(0, name.size() - unit.size() - 1);
  }
  return name;
}

// A distance and the name that has it.
struct Nearest {
  std::size_t distance = 0;
  const std::string* name = nullptr;
};

// The first of the nearest names within near_distance(); `reduced` is applied to the word and to each name.
template <typename Reduced>
Nearest nearest_of(std::string_view misspelt, const std::vector<std::string>& names, const Reduced& reduced) {
  const std::string_view word = reduced(misspelt);
  Nearest best{near_distance(word) + 1};
  for (const std::string& name : names) {
    if (misspelt.size() > kLongest) break;
    const std::size_t d = distance(word, reduced(name));
    if (d < best.distance) best = {d, &name};
  }
  return best;
}

// True if one of the words of `name`, and those behind it, begin with `part`: "sea_state" in "hh_sea_state".
bool has_words(std::string_view name, std::string_view part) {
  for (std::size_t begin = 0; begin + part.size() <= name.size(); ++begin) {
    const bool at_word = begin == 0 || std::string_view("_-.").find(name[begin - 1]) != std::string_view::npos;
    if (at_word && distance(name.substr(begin, part.size()), part) == 0) return true;
  }
  return false;
}

// Names that contain the word, or whose own words the word begins with.
std::vector<std::string_view> names_with(std::string_view misspelt, const std::vector<std::string>& names) {
  constexpr std::size_t kShortest = 3;
  const std::string_view word = without_unit(misspelt);
  std::vector<std::string_view> found;
  if (word.size() < kShortest || misspelt.size() > kLongest) return found;
  for (const std::string& name : names) {
    const std::string_view stem = without_unit(name);
    const bool begins = stem.size() > kShortest && word.size() > stem.size() &&
                        (word[stem.size()] == '_' || word[stem.size()] == '-') &&
                        distance(word.substr(0, stem.size()), stem) == 0;
    if (begins || has_words(name, word)) found.push_back(name);
  }
  return found;
}

}  // namespace

std::optional<std::string> nearest(std::string_view misspelt, const std::vector<std::string>& names) {
  const Nearest found = nearest_of(misspelt, names, [](std::string_view name) { return name; });
  return found.name == nullptr ? std::nullopt : std::optional(*found.name);
}

std::optional<std::string> near_suggestion(std::string_view misspelt, const std::vector<std::string>& names) {
  const Nearest whole = nearest_of(misspelt, names, [](std::string_view name) { return name; });
  const Nearest stem = nearest_of(misspelt, names, without_unit);
  const bool is_whole = whole.name != nullptr && (stem.name == nullptr || whole.distance <= stem.distance);
  if (const std::string* name = is_whole ? whole.name : stem.name) return fmt::format("did you mean '{}'?", *name);
  constexpr std::size_t kMost = 4;
  std::vector<std::string_view> with = names_with(misspelt, names);
  if (with.empty() || with.size() > kMost) return std::nullopt;
  const std::string last = fmt::format("'{}'?", with.back());
  with.pop_back();
  if (with.empty()) return "did you mean " + last;
  return fmt::format("did you mean '{}' or {}", fmt::join(with, "', '"), last);
}

std::string suggestion(std::string_view misspelt, const std::vector<std::string>& names) {
  const std::optional<std::string> near = near_suggestion(misspelt, names);
  return near ? *near : fmt::format("must be one of {}", fmt::join(names, ", "));
}

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

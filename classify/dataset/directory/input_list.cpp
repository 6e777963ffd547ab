// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/input_list.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "classify/dataset/format/checksum.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/shown.h"
#include "sim/core/text/text_source.h"
#include "sim/core/text/words.h"
#include "sim/geometry/files/mesh_io.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

// Checksums by key, from lines "CHECKSUM KEY".
std::map<std::string, std::string> read_list(const fs::path& file) {
  std::map<std::string, std::string> checksums;
  const TextSource source = TextSource::read(file);
  for (std::string_view rest = source.text(); !rest.empty();) {
    const std::string_view line = next_line(rest);
    const std::size_t gap = line.find("  ");
    if (gap == std::string_view::npos)
      source.fail(line, fmt::format("{}: must be a checksum and a key", in_quotes(line)));
    const bool is_new = checksums.emplace(line.substr(gap + 2), line.substr(0, gap)).second;
    if (!is_new) source.fail(line.substr(gap + 2), fmt::format("{} appears twice", in_quotes(line.substr(gap + 2))));
  }
  return checksums;
}

// Every file that the scenario names, and under "KEY/NAME" the buffer files of a mesh.
std::vector<InputFile> all_files(const Scenario& scenario) {
  std::vector<InputFile> files;
  for (const InputFile& named : input_files(scenario)) {
    files.push_back(named);
    if (!named.key.ends_with(".mesh")) continue;
    for (const fs::path& sidecar : sidecar_files(named.path)) {
      const fs::path name = sidecar.lexically_relative(fs::canonical(named.path).parent_path());
      files.push_back({fmt::format("{}/{}", named.key, name.string()), sidecar});
    }
  }
  return files;
}

}  // namespace

void require_same_inputs(const fs::path& directory, const Scenario& scenario) {
  const fs::path list = directory / kInputsFile;
  if (!fs::exists(list)) return;
  const std::map<std::string, std::string> checksums = read_list(list);
  for (const InputFile& file : all_files(scenario)) {
    const auto known = checksums.find(file.key);
    if (known != checksums.end() && known->second == sha256_file(file.path)) continue;
    throw InputError(fmt::format(
        "{}: {}: {} is not the file that the data set was begun with; bring that one back or choose another directory",
        list.string(), file.key, file.path.string()));
  }
}

void write_input_list(const fs::path& directory, const Scenario& scenario) {
  const fs::path list = directory / kInputsFile;
  if (fs::exists(list)) return;
  std::string text;
  for (const InputFile& file : all_files(scenario)) text += fmt::format("{}  {}\n", sha256_file(file.path), file.key);
  if (!text.empty()) write_file(list, text);
}

}  // namespace seaglint

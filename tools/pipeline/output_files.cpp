// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/output_files.h"

#include <fmt/format.h>

#include <set>
#include <system_error>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"

namespace seaglint {

void require_outputs(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs) {
  const auto place = [](const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path found = std::filesystem::weakly_canonical(file, error);
    return error ? file : found;
  };
  std::set<std::filesystem::path> read, written;
  for (const std::filesystem::path& file : inputs) read.insert(place(file));
  for (const std::string& file : outputs) {
    if (file.empty()) continue;
    if (read.contains(place(file))) throw InputError(fmt::format("{}: is read here, and would be written over", file));
    if (!written.insert(place(file)).second) throw InputError(fmt::format("{}: would be written twice", file));
    require_writable(file);
  }
}

std::vector<std::filesystem::path> files_of(const Scenario& scenario) {
  std::vector<std::filesystem::path> files;
  for (const InputFile& named : input_files(scenario)) files.push_back(named.path);
  return files;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "sim/core/process/file.h"

namespace seaglint {

// Contents of the files of a folder, by name.
inline std::map<std::string, std::string> bytes_of(const std::filesystem::path& directory) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    bytes[entry.path().filename()] = read_file(entry.path());
  return bytes;
}

}  // namespace seaglint

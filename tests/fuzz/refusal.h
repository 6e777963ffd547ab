// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the functions of readers.h share: a file for readers that want a path, and the refusal that is no fault.

#include <filesystem>
#include <fstream>
#include <string>

#include "sim/core/process/error.h"
#include "tests/temporary_folder.h"

namespace seaglint {

// Writes the bytes into a file of this name in a folder of this process (below TMPDIR); the next call replaces it.
inline std::filesystem::path file_of(const std::string& bytes, const char* name) {
  static const TemporaryFolder folder;
  std::filesystem::path path = folder.path() / name;
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

// Calls use(); true if it threw an InputError, false if it returned.
template <class Use>
bool is_refused(Use use) {
  try {
    use();
    return false;
  } catch (const InputError& error) {
    const std::string message = error.what();
    SEAGLINT_CHECK(!message.empty(), "an InputError without a message");
    return true;
  }
}

}  // namespace seaglint

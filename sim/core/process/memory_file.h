// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A file in memory without a name, for input and output of child processes.

#include <string>
#include <string_view>

namespace seaglint {

class MemoryFile {
 public:
  explicit MemoryFile(std::string_view content = {});  // throws WorkError with the system error
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  // At the beginning of the file; closed in child processes unless it is duplicated for them.
  int descriptor() const { return descriptor_; }

  // The whole content; throws WorkError.
  std::string content() const;

 private:
  int descriptor_;
};

}  // namespace seaglint

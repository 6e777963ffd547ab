// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Temporary files `<name>.<16 hexadecimal digits>.tmp` beside the file that they become. The digits are random, the
// file is created exclusively, and its process holds a lock on it (an open file description lock), which the system
// releases when the process ends: a file without a lock is a leftover. Neither host nor process number is used, which
// are equal in different containers.

#include <filesystem>
#include <string_view>

namespace seaglint {

class TemporaryFile {
 public:
  // Creates and locks a new file beside `target`, whose name stands in error messages. Where the file system has no
  // locks, the file is created without. Throws WorkError with the system error.
  explicit TemporaryFile(std::filesystem::path target);
  ~TemporaryFile();  // removes the file unless it was published
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

  void write(std::string_view content);  // appends

  // Waits until the data are on the disk and renames the file to the target. Throws WorkError with the system error,
  // also when the file was removed or replaced.
  void publish();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path target_, path_;
  int descriptor_ = -1;
};

// The part of a name before ".<16 hexadecimal digits>.tmp"; empty for any other name.
std::string_view target_of_temporary(std::string_view name);

// True for a temporary file that no process is writing: nobody holds its lock or, where the file system has no locks,
// it was not modified for a day.
bool is_leftover(const std::filesystem::path& file);

// Removes the file if it is a leftover; a file that cannot be removed remains.
void remove_leftover(const std::filesystem::path& file);

// Removes the leftovers in a folder, with a name those of this target alone; what cannot be read or removed remains.
void remove_leftovers(const std::filesystem::path& folder, std::string_view target = {});

}  // namespace seaglint

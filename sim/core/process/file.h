// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reading of files; atomic output: a file is written next to its destination under a random name (TemporaryFile),
// synchronised, renamed. Two processes may write the same file; the later rename prevails.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace seaglint {

// True if the path exists and its status may be read; throws WorkError, with the system error, when the disk or the
// system fails, which leaves that open.
bool is_there(const std::filesystem::path& path);

// Throws InputError when the file is missing, not a regular file, or larger than max_bytes; WorkError, with the system
// error, when the disk or the system fails.
std::string read_file(const std::filesystem::path& path, std::size_t max_bytes = std::size_t{1} << 30);

// Passes a file of any size to use() in blocks of up to 64 KiB; the errors of read_file().
void read_blocks(const std::filesystem::path& path, const std::function<void(std::string_view)>& use);

// Throws WorkError (with the system error) when writing fails; no partial file remains.
void write_file(const std::filesystem::path& path, std::string_view content);

// Throws the WorkError of write_file() when the directory of the file is missing or not writable; called before long
// work. An empty path is accepted.
void require_writable(const std::filesystem::path& path);

// Calls write(temporary path), synchronises and renames; for libraries with file output of their own, which open this
// file and neither remove nor replace it. Throws WorkError when it is then empty.
void write_file_with(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write);

// Creates the directory and its parents; throws WorkError with the system error when this fails or the directory is not
// writable.
void make_directory(const std::filesystem::path& path);

// Temporary files `<name>.<16 hexadecimal digits>.tmp` beside the file that they become. The digits are random, the
// file is created exclusively, and its process holds a lock on it (an open file description lock), which the system
// releases when the process ends: a file without a lock is a leftover. Neither host nor process number is used, which
// are equal in different containers.

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

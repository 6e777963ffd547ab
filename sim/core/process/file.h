// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Atomic file output: written next to the destination under a random name (sim/core/process/temporary_file.h),
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

// Writes a file of any size: calls write(append), which passes the content to append() in parts. The errors of
// write_file(); an exception of write() leaves no file.
using AppendText = std::function<void(std::string_view)>;
void write_blocks(const std::filesystem::path& path, const std::function<void(const AppendText&)>& write);

// Throws the WorkError of write_file() when the directory of the file is missing or not writable; called before long
// work. An empty path is accepted.
void require_writable(const std::filesystem::path& path);

// Calls write(temporary path), synchronises and renames; for libraries with file output of their own, which open this
// file and neither remove nor replace it. Throws WorkError when it is then empty.
void write_file_with(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write);

// Creates the directory and its parents; throws WorkError with the system error when this fails or the directory is not
// writable.
void make_directory(const std::filesystem::path& path);

}  // namespace seaglint

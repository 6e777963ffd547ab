// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Files that are either whole or absent: written beside their place as `<name>.<host>-<process>.tmp`, synchronised,
// renamed. The temporary name is the process's own, so that two processes may write the same file: the last one counts.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace seaglint {

// Where the file is that `where` names: beside `folder`, else below the working directory. InputError when in neither.
std::filesystem::path find_file(const std::string& name, const std::filesystem::path& folder, const std::string& where);

// Throws InputError when the file is missing, not a regular file, or larger than max_bytes.
std::string read_file(const std::filesystem::path& path, std::size_t max_bytes = std::size_t{1} << 30);

// Throws WorkError (with the system's reason) when the directory or disk refuses; then nothing is left behind.
void write_file(const std::filesystem::path& path, std::string_view content);

// Throws the WorkError that write_file would where the file's directory is missing or refuses, before long work is done
// for nothing. An empty path names no file.
void require_writable(const std::filesystem::path& path);

// Calls write(temporary path), synchronises and renames; for libraries that write files themselves.
void write_file_with(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write);

// Creates the directory and its parents; throws WorkError with the reason when it cannot, or when it is not writable.
void make_directory(const std::filesystem::path& path);

}  // namespace seaglint

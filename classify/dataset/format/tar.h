// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Writes tar archives in the USTAR format (POSIX.1-1988): regular files of mode 0644 whose owner and times are zero, so
// that the bytes depend only on names and contents.

#include <cstdint>
#include <string>
#include <string_view>

#include "sim/core/process/file.h"

namespace seaglint {

class TarWriter {
 public:
  explicit TarWriter(const AppendText& append) : append_(append) {}  // which lives as long as the writer

  // Appends a file. `name` has 1 to 100 bytes, `content` less than 8 GiB.
  void add(const std::string& name, std::string_view content);
  // Appends the end of the archive, padded to a multiple of 10 KiB as tar(1) does.
  void finish();

  // Bytes of the archive up to now, without its end.
  std::uint64_t bytes() const { return bytes_; }

  // Bytes that a file of this size takes in an archive, and those of an archive with `bytes` of such.
  static std::uint64_t member_bytes(std::uint64_t content_bytes);
  static std::uint64_t archive_bytes(std::uint64_t bytes);

 private:
  void append(std::string_view part);

  const AppendText& append_;
  std::uint64_t bytes_ = 0;
};

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/hdf5_image.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace seaglint {

namespace {

// Superblock of version 2 or 3 (HDF5 File Format Specification 3.0, section II.A): signature, version in byte 8,
// address of the end of the file in bytes 28 to 35, root group in 36 to 43, checksum in 44 to 47.
constexpr std::size_t kVersion = 8, kEnd = 28, kRoot = 36, kChecksum = 44, kSuperblock = 48;

}  // namespace

std::optional<std::uint64_t> end_of_file(const Hdf5Image& image) {
  const std::string& bytes = image.bytes;
  if (bytes.size() < kSuperblock || !bytes.starts_with("\x89HDF") || bytes[kVersion] < 2) return std::nullopt;
  std::uint64_t end = 0;
  std::memcpy(&end, bytes.data() + kEnd, sizeof end);
  return end;
}

bool has_bytes_of(const Hdf5Image& file, const Hdf5Image& written) {
  if (file.bytes.size() < kSuperblock || file.bytes.size() > written.bytes.size()) return false;
  const auto equal = [&](std::size_t first, std::size_t end) {
    return std::equal(file.bytes.begin() + first, file.bytes.begin() + end, written.bytes.begin() + first);
  };
  return equal(0, kEnd) && equal(kRoot, kChecksum) && equal(kSuperblock, file.bytes.size());
}

}  // namespace seaglint

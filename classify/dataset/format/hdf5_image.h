// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The bytes of a whole HDF5 file.

#include <cstdint>
#include <optional>
#include <string>

namespace seaglint {

struct Hdf5Image {
  std::string bytes;
};

// The address of the end of the file as its superblock has it; none if it has no superblock of version 2 or 3.
std::optional<std::uint64_t> end_of_file(const Hdf5Image& image);

// True if the file has the bytes of `written`, an image of Hdf5Writer::image(), which has free space behind them. End
// and checksum in the superblock are left to the reader.
bool has_bytes_of(const Hdf5Image& file, const Hdf5Image& written);

}  // namespace seaglint

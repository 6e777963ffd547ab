// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

namespace seaglint {

// Whether the object header of version 1 at this address of an HDF5 file has one layout message of version 3, whose
// chunks, if any, have one extent and none of 0, and types of versions 1 and 2 of more than 0 bytes, members within
// their compounds: HDF5 1.10 divides by these when it opens the array (HDF5 File Format Specification 3.0, sections
// IV.A.1.a, IV.A.2.d and IV.A.2.i). PyTables writes these versions.
bool has_sound_header(const std::filesystem::path& file, std::uint64_t address);

// Whether the free list of every local heap in the file, where names of groups' members lie, ends within its heap and
// the heap within the file: HDF5 1.10 follows the list without end if it is a circle (section III.D).
bool has_sound_heaps(const std::filesystem::path& file);

}  // namespace seaglint

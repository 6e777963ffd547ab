// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

namespace seaglint {

// Whether the object header of version 1 at this address of an HDF5 file has one layout message of version 3, whose
// chunks, if any, have no extent of 0: HDF5 1.10 divides by it when it opens such an array (HDF5 File Format
// Specification 3.0, sections IV.A.1.a and IV.A.2.i). PyTables writes these versions.
bool has_sound_layout(const std::filesystem::path& file, std::uint64_t address);

}  // namespace seaglint

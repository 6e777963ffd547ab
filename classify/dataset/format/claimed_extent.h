// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Checks of extents and sizes that a file merely claims, before anything is allocated for them. All throw WorkError
// naming the array.

#include <cstddef>
#include <cstdint>
#include <string>

#include "classify/dataset/format/array_type.h"

namespace seaglint {

// The number of elements of an array that must have `rank` dimensions.
std::size_t claimed_count(const std::string& path, const Dimensions& extent, ArrayType element, std::size_t rank);

// Rows `first` to `first + count - 1` must exist in an array of one dimension.
void require_rows(const std::string& path, const Dimensions& extent, std::uint64_t first, std::uint64_t count);

// Chunks must have the bytes that their array needs, in a file that has as many.
void require_chunk_bytes(const std::string& path, double claimed, double needed, double file_bytes);

}  // namespace seaglint

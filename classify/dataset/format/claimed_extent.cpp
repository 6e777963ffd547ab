// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/claimed_extent.h"

#include <fmt/format.h>

#include "sim/core/process/error.h"

namespace seaglint {

std::size_t claimed_count(const std::string& path, const Dimensions& extent, ArrayType element, std::size_t rank) {
  if (extent.size() != rank) throw WorkError(fmt::format("{} has not {} dimensions", path, rank));
  constexpr double kMaxBytes = 1e15;  // reached only by a virtual array, whose extent nothing else limits
  if (chunked_bytes(extent, extent, element_bytes(element), 0) > kMaxBytes)
    throw WorkError(fmt::format("{} claims more bytes than it has", path));
  return element_count(extent);
}

void require_rows(const std::string& path, const Dimensions& extent, std::uint64_t first, std::uint64_t count) {
  if (extent.size() != 1 || first > extent[0] || count > extent[0] - first)
    throw WorkError(fmt::format("{} has no rows {} to {}", path, first, first + count));
}

void require_chunk_bytes(const std::string& path, double claimed, double needed, double file_bytes) {
  if (claimed < needed) throw WorkError(fmt::format("{} is incomplete", path));
  if (claimed > needed || needed > file_bytes) throw WorkError(fmt::format("{} claims more bytes than it has", path));
}

}  // namespace seaglint

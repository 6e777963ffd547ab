// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Numbers in binary files.

#include <array>
#include <bit>
#include <cstddef>

namespace seaglint {

// The number of type T whose bytes begin here; swap: in the other byte order than the machine's.
template <typename T>
T number_at(const char* bytes, bool swap) {
  std::array<char, sizeof(T)> raw{};
  for (std::size_t i = 0; i < raw.size(); ++i) raw[i] = bytes[swap ? raw.size() - 1 - i : i];
  return std::bit_cast<T>(raw);
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Element types, sizes and stored names of a data set's arrays.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace seaglint {

inline constexpr std::size_t kNameBytes = 64;  // of a string in an array, UTF-8, zero-padded

// Element type of an array; kName is kNameBytes characters.
enum class ArrayType { kFloat, kDouble, kInt64, kUint16, kName };

template <class T>
constexpr ArrayType array_type_of() {
  if constexpr (std::is_same_v<T, float>) return ArrayType::kFloat;
  if constexpr (std::is_same_v<T, double>) return ArrayType::kDouble;
  if constexpr (std::is_same_v<T, std::int64_t>) return ArrayType::kInt64;
  if constexpr (std::is_same_v<T, std::uint16_t>) return ArrayType::kUint16;
  if constexpr (std::is_same_v<T, std::string>) return ArrayType::kName;
}

std::size_t element_bytes(ArrayType element);

using Dimensions = std::vector<std::uint64_t>;

// Number of elements; of sizes that a file merely claims use the other function, which cannot overflow.
std::uint64_t element_count(std::span<const std::uint64_t> size);

// Bytes of an array of elements of `element` bytes that is divided into chunks, with `overhead` bytes for each; the
// last chunk of a dimension is stored whole. Infinite for chunks of length 0.
double chunked_bytes(std::span<const std::uint64_t> size, std::span<const std::uint64_t> chunk, std::size_t element,
                     std::size_t overhead);

// Names in stored form, kNameBytes each, and back.
std::string packed_names(std::span<const std::string> names);
std::vector<std::string> unpacked_names(std::string_view text);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/array_type.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>

namespace seaglint {

std::size_t element_bytes(ArrayType element) {
  switch (element) {
    case ArrayType::kFloat: return sizeof(float);
    case ArrayType::kUint16: return sizeof(std::uint16_t);
    case ArrayType::kName: return kNameBytes;
    default: return sizeof(double);
  }
}

std::uint64_t element_count(std::span<const std::uint64_t> size) {
  return std::accumulate(size.begin(), size.end(), std::uint64_t{1}, std::multiplies<>());
}

double chunked_bytes(std::span<const std::uint64_t> size, std::span<const std::uint64_t> chunk, std::size_t element,
                     std::size_t overhead) {
  double chunks = 1, bytes = static_cast<double>(element);
  for (std::size_t i = 0; i < size.size(); ++i) {
    if (i >= chunk.size() || chunk[i] == 0) return std::numeric_limits<double>::infinity();
    const auto length = static_cast<double>(chunk[i]);
    chunks *= std::ceil(static_cast<double>(size[i]) / length);
    bytes *= length;
  }
  return chunks * (bytes + static_cast<double>(overhead));
}

std::string packed_names(std::span<const std::string> names) {
  std::string text(names.size() * kNameBytes, '\0');
  for (std::size_t i = 0; i < names.size(); ++i)
    std::memcpy(text.data() + i * kNameBytes, names[i].data(), std::min(names[i].size(), kNameBytes));
  return text;
}

std::vector<std::string> unpacked_names(std::string_view text) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < text.size(); i += kNameBytes)
    names.emplace_back(text.data() + i, strnlen(text.data() + i, kNameBytes));
  return names;
}

}  // namespace seaglint

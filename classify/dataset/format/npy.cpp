// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/npy.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <functional>
#include <numeric>

#include "sim/core/process/error.h"

namespace seaglint {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

const char* numpy_type(ArrayType element) {
  switch (element) {
    case ArrayType::kFloat: return "<f4";
    case ArrayType::kInt64: return "<i8";
    case ArrayType::kUint16: return "<u2";
    case ArrayType::kName: return "|S64";
    default: return "<f8";
  }
}

std::string npy_header(const std::string& type, std::span<const std::uint64_t> shape) {
  std::string lengths;
  for (const std::uint64_t length : shape) lengths += fmt::format("{}, ", length);
  if (shape.size() > 1) lengths.resize(lengths.size() - 2);
  if (shape.size() == 1) lengths.pop_back();
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, lengths);
  constexpr std::size_t kAlignment = 64, kBefore = 10;  // magic, version and length
  const std::size_t padded = (kBefore + text.size() + 1 + kAlignment - 1) / kAlignment * kAlignment - kBefore;
  text.resize(padded - 1, ' ');
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(padded & 0xff);
  header += static_cast<char>(padded >> 8);
  return header + text;
}

std::uint64_t npy_data_bytes(const std::string& type, std::span<const std::uint64_t> shape) {
  std::uint64_t item = 0;
  const auto [end, error] = std::from_chars(type.data() + 2, type.data() + type.size(), item);
  SEAGLINT_CHECK(error == std::errc() && end == type.data() + type.size() && item > 0, type);
  return std::accumulate(shape.begin(), shape.end(), item, std::multiplies<>());
}

}  // namespace seaglint

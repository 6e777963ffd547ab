// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/ply_number.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "sim/geometry/files/polygons/binary_number.h"

namespace seaglint {
namespace {

// Smallest and largest value of an integer type; infinite for the others.
std::pair<double, double> range_of(PlyNumber type) {
  switch (type) {
    case PlyNumber::kInt8: return {-128, 127};
    case PlyNumber::kUint8: return {0, 255};
    case PlyNumber::kInt16: return {-32768, 32767};
    case PlyNumber::kUint16: return {0, 65535};
    case PlyNumber::kInt32: return {-2147483648.0, 2147483647.0};
    case PlyNumber::kUint32: return {0, 4294967295.0};
    case PlyNumber::kFloat:
    case PlyNumber::kDouble: break;
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {-kInfinity, kInfinity};
}

}  // namespace

std::optional<PlyNumber> ply_number(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, PlyNumber>, 16> kNames{{{"char", PlyNumber::kInt8},
                                                                           {"int8", PlyNumber::kInt8},
                                                                           {"uchar", PlyNumber::kUint8},
                                                                           {"uint8", PlyNumber::kUint8},
                                                                           {"short", PlyNumber::kInt16},
                                                                           {"int16", PlyNumber::kInt16},
                                                                           {"ushort", PlyNumber::kUint16},
                                                                           {"uint16", PlyNumber::kUint16},
                                                                           {"int", PlyNumber::kInt32},
                                                                           {"int32", PlyNumber::kInt32},
                                                                           {"uint", PlyNumber::kUint32},
                                                                           {"uint32", PlyNumber::kUint32},
                                                                           {"float", PlyNumber::kFloat},
                                                                           {"float32", PlyNumber::kFloat},
                                                                           {"double", PlyNumber::kDouble},
                                                                           {"float64", PlyNumber::kDouble}}};
  for (const auto& [known, type] : kNames) {
    if (name == known) return type;
  }
  return std::nullopt;
}

std::size_t size_of(PlyNumber type) {
  switch (type) {
    case PlyNumber::kInt8:
    case PlyNumber::kUint8: return 1;
    case PlyNumber::kInt16:
    case PlyNumber::kUint16: return 2;
    case PlyNumber::kInt32:
    case PlyNumber::kUint32:
    case PlyNumber::kFloat: return 4;
    case PlyNumber::kDouble: return 8;
  }
  return 0;
}

bool holds(PlyNumber type, double value) {
  const auto [lowest, highest] = range_of(type);
  return std::isinf(highest) || (value >= lowest && value <= highest && value == std::floor(value));
}

std::string limits_of(PlyNumber type) {
  const auto [lowest, highest] = range_of(type);
  return fmt::format("a whole number within {} and {}", lowest, highest);
}

double value_at(PlyNumber type, const char* bytes, bool swap) {
  switch (type) {
    case PlyNumber::kInt8: return number_at<std::int8_t>(bytes, swap);
    case PlyNumber::kUint8: return number_at<std::uint8_t>(bytes, swap);
    case PlyNumber::kInt16: return number_at<std::int16_t>(bytes, swap);
    case PlyNumber::kUint16: return number_at<std::uint16_t>(bytes, swap);
    case PlyNumber::kInt32: return number_at<std::int32_t>(bytes, swap);
    case PlyNumber::kUint32: return number_at<std::uint32_t>(bytes, swap);
    case PlyNumber::kFloat: return number_at<float>(bytes, swap);
    case PlyNumber::kDouble: return number_at<double>(bytes, swap);
  }
  return 0;
}

}  // namespace seaglint

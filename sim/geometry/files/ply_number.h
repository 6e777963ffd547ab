// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Types of numbers in PLY files.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace seaglint {

enum class PlyNumber { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

// The type of this name, in either spelling ("uchar", "uint8").
std::optional<PlyNumber> ply_number(std::string_view name);

std::size_t size_of(PlyNumber type);  // bytes

// Whether a number of a text can be of the type: whole and within its limits, or any for floating-point types.
bool holds(PlyNumber type, double value);
std::string limits_of(PlyNumber type);  // "a whole number within 0 and 255"

// The number whose bytes begin here; swap: in the other byte order than the machine's.
double value_at(PlyNumber type, const char* bytes, bool swap);

}  // namespace seaglint

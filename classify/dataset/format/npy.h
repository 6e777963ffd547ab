// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// NumPy's .npy format, version 1.0 (numpy/lib/format.py): a header, then the values in C order, little-endian.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "classify/dataset/format/array_type.h"

namespace seaglint {

// NumPy's type string of an element: "<f4", "<f8", "<i8", "<u2", "|S64".
const char* numpy_type(ArrayType element);

// The header: magic, length, a Python dictionary, padded to a multiple of 64 bytes. `shape` is empty for a single
// value.
std::string npy_header(const std::string& type, std::span<const std::uint64_t> shape);

// What a header states.
struct NpyHeader {
  std::string type;
  std::vector<std::uint64_t> shape;
  std::size_t bytes = 0;  // of the header itself
};

// Reads the header of a .npy file of format version 1 to 3. Throws InputError, a sentence without the file's name,
// unless it is one in C order.
NpyHeader read_npy_header(std::string_view file);

// Bytes of the values behind the header.
std::uint64_t npy_data_bytes(const std::string& type, std::span<const std::uint64_t> shape);

// Bytes of the values in memory order.
template <class T>
std::string bytes_of_values(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

// A whole .npy file; `values` has as many values as `shape`.
template <class T>
std::string npy_file(std::span<const std::uint64_t> shape, std::span<const T> values, const std::string& type) {
  return npy_header(type, shape) + bytes_of_values(values);
}

}  // namespace seaglint

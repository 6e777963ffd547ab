// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// NumPy's .npy format, version 1.0 (numpy/lib/format.py): a header, then the values in C order, little-endian. NumPy's
// .npz: an uncompressed zip archive of one .npy file per array. The bytes depend only on the arrays: all times in the
// archive are 1980-01-01, the earliest of the zip format. Memory holds only the block being written; archives and
// arrays above 4 GB are zip64, which NumPy reads.

#include <complex>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "classify/dataset/format/hdf5_file.h"

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

// Returns the next block of an array's bytes in C order, little-endian; empty at the end.
using NextBlock = std::function<std::string()>;

struct NpzArray {
  std::string name;                  // "samples/label"; the file inside is samples/label.npy
  std::string type;                  // NumPy type string: "<f4", "<f8", "<i8", "<u2", "<c8", "|S64"
  std::vector<std::uint64_t> shape;  // empty for a single value
  NextBlock next;
};

struct NpzText {
  std::string name;  // of the file inside, "units.json"
  std::string text;
};

// NpzArray of values in memory, which are copied.
NpzArray npz_array(std::string name, std::string type, std::vector<std::uint64_t> shape, std::string bytes);

// Reads the text file `name` inside an archive. Throws InputError naming the archive if it has no such file of at most
// 4 MB, the limit of scenarios.
std::string read_npz_text(const std::filesystem::path& file, const std::string& name);

// Names of the files inside an archive, "time_s.npy". Throws InputError naming the file if it is no complete archive.
std::vector<std::string> npz_members(const std::filesystem::path& file);

// An array in memory: its values in C order.
struct NpzValues {
  std::string type;
  std::vector<std::uint64_t> shape;
  std::string bytes;

  std::string shape_text() const;  // "(256, 1914)"
  // Values of type f4, f8, i4, i8 or u2; of type c8 or c16. Throw InputError, a sentence without names, for other
  // types.
  std::vector<double> numbers() const;
  std::vector<std::complex<double>> complex_numbers() const;
};

// Reads the array `name` of an uncompressed archive (numpy.savez), which takes no more memory than the file. Throws
// InputError naming archive and array when there is none, it is compressed or damaged, or its bytes are not those of
// its shape.
NpzValues read_npz_array(const std::filesystem::path& file, const std::string& name);

// Throws InputError unless the name ends in .npz, WorkError if write_npz() could not write there. An empty name passes.
void require_npz(const std::filesystem::path& file);

// Writes the archive completely or not at all, arrays in the given order. Exceptions of next() propagate; an array that
// does not yield the bytes of its shape is a programming error. Throws WorkError when the file cannot be written.
void write_npz(const std::filesystem::path& file, const std::vector<NpzArray>& arrays,
               const std::vector<NpzText>& texts = {});

}  // namespace seaglint

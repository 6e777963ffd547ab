// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Arrays as NumPy's .npz: a zip archive, not compressed, of one .npy file (format version 1.0) per array. Bytes depend
// on the arrays alone: the archive's times are all 1980-01-01, the first that a zip can say. libzip keeps no more of an
// array than the block it is writing; archives and arrays above 4 GB are zip64, which NumPy reads.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seaglint {

// The next block of an array's bytes in C order, little-endian; empty at its end.
using NextBlock = std::function<std::string()>;

struct NpzArray {
  std::string name;                  // "samples/label"; the file inside is samples/label.npy
  std::string type;                  // as NumPy says it: "<f4", "<f8", "<i8", "<u2", "<c8", "|S64"
  std::vector<std::uint64_t> shape;  // empty for a single value
  NextBlock next;
};

struct NpzText {
  std::string name;  // of the file inside, "units.json"
  std::string text;
};

// An array that lies in memory; the values are copied.
NpzArray npz_array(std::string name, std::string type, std::vector<std::uint64_t> shape, std::string bytes);

// The bytes of values as they lie in memory.
template <class T>
std::string bytes_of_values(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

// The text file `name` inside an archive. Throws InputError naming the archive where there is none of at most 16 MB.
std::string read_npz_text(const std::filesystem::path& file, const std::string& name);

// Throws InputError unless the name ends in .npz, and WorkError where write_npz() would find the place refusing. An
// empty name is none.
void require_npz(const std::filesystem::path& file);

// Writes the archive whole or not at all, arrays in their order. What next() throws is passed on; an array that does
// not yield the bytes of its shape is a programmer's error. Throws WorkError when the disk refuses.
void write_npz(const std::filesystem::path& file, const std::vector<NpzArray>& arrays,
               const std::vector<NpzText>& texts = {});

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The subset of HDF5 that data sets use: arrays in chunks, each with a Fletcher-32 checksum, and virtual arrays. The
// bytes depend only on the content: no times, fixed little-endian types. Files are opened without HDF5 locks, which
// some cluster file systems do not support; no file is read while it is written, because files appear by renaming. Only
// one thread at a time may use the library.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace seaglint {

// Element types, sizes and stored names of arrays.

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

// The bytes of a whole HDF5 file.
struct Hdf5Image {
  std::string bytes;
};

// The address of the end of the file as its superblock has it; none if it has no superblock of version 2 or 3.
std::optional<std::uint64_t> end_of_file(const Hdf5Image& image);

// True if the file has the bytes of `written`, an image of Hdf5Writer::image(), which has free space behind them. End
// and checksum in the superblock are left to the reader.
bool has_bytes_of(const Hdf5Image& file, const Hdf5Image& written);

// Attributes of an array.
struct ArrayText {
  std::string units;  // "1" if dimensionless
  std::string description;
};

// Source of rows `first` to `first + count - 1` of a virtual array: the whole array of the same path in `file`
// (relative to the folder of the virtual array's file).
struct VirtualSource {
  std::string file;
  std::uint64_t first = 0;
  std::uint64_t count = 0;

  bool operator==(const VirtualSource&) const = default;
};

// The HDF5 library serves one thread at a time: locked where several threads may read or write.
inline std::mutex& hdf5_mutex() {
  static std::mutex mutex;
  return mutex;
}

enum class Hdf5Version { k18, k110 };  // oldest library that reads the file; virtual arrays need 1.10

// Writes an HDF5 file. Every call throws WorkError naming what could not be written and the system's reason.
class Hdf5Writer {
 public:
  Hdf5Writer(const std::filesystem::path& file, Hdf5Version version);
  explicit Hdf5Writer(Hdf5Version version);  // in memory
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  void attribute(const std::string& name, const std::string& text);  // of the file
  void group(const std::string& path);

  // Creates an array in chunks of `chunk`, each with a Fletcher-32 checksum; filled by write().
  void array(const std::string& path, ArrayType element, const Dimensions& size, const Dimensions& chunk,
             const ArrayText& text);
  // Creates an array whose rows are in other files; rows of a missing file read as NaN or the largest integer.
  void virtual_array(const std::string& path, ArrayType element, const Dimensions& size,
                     std::span<const VirtualSource> sources, const ArrayText& text);

  // Writes rows from `first` on; `values` contains complete rows.
  template <class T>
  void write(const std::string& path, std::uint64_t first, std::span<const T> values) {
    if constexpr (std::is_same_v<T, std::string>) {
      write_bytes(path, ArrayType::kName, first, packed_names(values).data(), values.size());
    } else {
      write_bytes(path, array_type_of<T>(), first, values.data(), values.size());
    }
  }

  void close();  // must be called: reports late write errors

  // The file in memory; nothing may be written afterwards.
  Hdf5Image image();

 private:
  void write_bytes(const std::string& path, ArrayType element, std::uint64_t first, const void* values,
                   std::size_t count);
  struct Open;
  std::unique_ptr<Open> open_;
};

template <class T>
struct ReadArray {
  Dimensions size;
  std::vector<T> values;
};

// Reads an HDF5 file that may be damaged in any way or made to deceive: every call throws WorkError naming what is
// missing or wrong, std::bad_alloc when memory is exhausted. Arrays are reached by hard links and have the expected
// type; they are stored in chunks of this file with no filter but the checksum, and need no more bytes than the file
// has. External files and links, other filters (which HDF5 would load as libraries) and fill values are thereby
// excluded. Virtual arrays are read from a file on the disk only.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const Hdf5Image& image);
  explicit Hdf5Reader(const std::filesystem::path& file);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  std::string attribute(const std::string& name) const;  // of the file; "" if there is none
  bool has(const std::string& path) const;
  Dimensions size(const std::string& path) const;
  // Empty for an array of this file. Opens no source; size() of a virtual array may, so that its sources are compared
  // first.
  std::vector<VirtualSource> sources(const std::string& path) const;

  // Reads a whole array, which must have `rank` dimensions. The allocation is limited by the file's size or, for a
  // virtual array, by its declared size.
  template <class T>
  ReadArray<T> read(const std::string& path, std::size_t rank) const {
    ReadArray<T> array;
    array.size = size(path);
    array.values.resize(checked_count(path, array_type_of<T>(), rank));
    read_bytes(path, array_type_of<T>(), 0, array.size.empty() ? 0 : array.size[0], array.values.data());
    return array;
  }
  // Rows of an array of one dimension.
  template <class T>
  std::vector<T> rows(const std::string& path, std::uint64_t first, std::uint64_t count) const {
    checked_rows(path, array_type_of<T>(), first, count);
    if constexpr (std::is_same_v<T, std::string>) {
      std::string text(count * kNameBytes, '\0');
      read_bytes(path, ArrayType::kName, first, count, text.data());
      return unpacked_names(text);
    } else {
      std::vector<T> values(count);
      read_bytes(path, array_type_of<T>(), first, count, values.data());
      return values;
    }
  }

 private:
  void require_type(const std::string& path, ArrayType element) const;
  std::size_t checked_count(const std::string& path, ArrayType element, std::size_t rank) const;
  void checked_rows(const std::string& path, ArrayType element, std::uint64_t first, std::uint64_t count) const;
  void read_bytes(const std::string& path, ArrayType element, std::uint64_t first, std::uint64_t count,
                  void* values) const;
  struct Open;
  std::unique_ptr<Open> open_;
};

}  // namespace seaglint

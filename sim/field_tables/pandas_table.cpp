// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/field_formats.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

constexpr std::uint64_t kMaxBlock = 1 << 20;  // bytes
constexpr std::size_t kMaxBlocks = 256;

// Unsigned number of `bytes` bytes; the caller has checked the bounds.
std::uint64_t number(std::string_view text, std::size_t at, std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t n = bytes; n > 0; --n) value = value << 8 | static_cast<unsigned char>(text[at + n - 1]);
  return value;
}

std::optional<std::string> bytes_at(std::ifstream& file, std::uint64_t address, std::uint64_t count) {
  if (count > kMaxBlock || address > std::uint64_t{1} << 62) return std::nullopt;
  std::string bytes(count, '\0');
  file.clear();
  file.seekg(static_cast<std::streamoff>(address));
  if (!file.read(bytes.data(), static_cast<std::streamsize>(count))) return std::nullopt;
  return bytes;
}

bool is_sound_layout(std::string_view message) {
  constexpr std::uint64_t kVersion = 3, kChunked = 2;
  if (message.size() < 3 || number(message, 0, 1) != kVersion) return false;
  if (number(message, 1, 1) != kChunked) return true;
  const std::uint64_t rank = number(message, 2, 1);
  constexpr std::size_t kExtents = 11;                                  // behind version, class, rank and address
  if (rank != 2 || message.size() < kExtents + 4 * rank) return false;  // rows, and bytes of one
  for (std::size_t k = 0; k < rank; ++k) {
    if (number(message, kExtents + 4 * k, 4) == 0) return false;
  }
  return true;
}

// Goes past a datatype of version 1 or 2: numbers, texts, arrays and compounds of them, none of 0 bytes, members within
// their compound. False for another one.
bool skip_sound_type(std::string_view& rest, std::uint64_t most_bytes, int depth) {
  constexpr std::uint64_t kInteger = 0, kReal = 1, kText = 3, kCompound = 6, kArray = 10, kMaxDepth = 4;
  if (rest.size() < 8 || depth > static_cast<int>(kMaxDepth)) return false;
  const std::uint64_t type = number(rest, 0, 1) & 15, version = number(rest, 0, 1) >> 4, bytes = number(rest, 4, 4);
  const std::uint64_t members = number(rest, 1, 2);
  rest.remove_prefix(8);
  if (bytes == 0 || bytes > most_bytes || version < 1 || version > 2) return false;
  const auto skip = [&](std::uint64_t count) {
    if (count > rest.size()) return false;
    rest.remove_prefix(count);
    return true;
  };
  if (type == kInteger) return skip(4);
  if (type == kReal) return skip(12);
  if (type == kText) return true;
  if (type == kArray) {
    if (rest.empty()) return false;
    const std::uint64_t rank = number(rest, 0, 1);
    return version == 2 && skip(4 + 8 * rank) && skip_sound_type(rest, bytes, depth + 1);
  }
  if (type != kCompound || members == 0) return false;
  for (std::uint64_t k = 0; k < members; ++k) {
    const std::size_t name = rest.find('\0');
    if (name == std::string_view::npos || !skip(name / 8 * 8 + 8) || rest.size() < 4) return false;
    const std::uint64_t offset = number(rest, 0, 4);
    if (offset >= bytes || !skip(version == 1 ? 32 : 4) || !skip_sound_type(rest, bytes - offset, depth + 1))
      return false;
  }
  return true;
}

bool is_sound_type(std::string_view message) {
  constexpr std::uint64_t kMaxRow = 65536;  // bytes
  return skip_sound_type(message, kMaxRow, 0);
}

// Whether the object header of version 1 at this address of an HDF5 file has one layout message of version 3, whose
// chunks, if any, have one extent and none of 0, and types of versions 1 and 2 of more than 0 bytes, members within
// their compounds: HDF5 1.10 divides by these when it opens the array (HDF5 File Format Specification 3.0, sections
// IV.A.1.a, IV.A.2.d and IV.A.2.i). PyTables writes these versions.
bool has_sound_header(const std::filesystem::path& path, std::uint64_t address) {
  constexpr std::uint64_t kHead = 16, kMessageHead = 8, kType = 0x3, kLayout = 0x8, kContinuation = 0x10, kShared = 2;
  std::ifstream file(path, std::ios::binary);
  const std::optional<std::string> head = bytes_at(file, address, kHead);
  if (!head || number(*head, 0, 1) != 1) return false;
  struct Block {
    std::uint64_t address, bytes;
  };
  std::vector<Block> blocks{{address + kHead, number(*head, 8, 4)}};
  int layouts = 0;
  for (std::size_t n = 0; n < blocks.size() && n < kMaxBlocks; ++n) {
    const std::optional<std::string> block = bytes_at(file, blocks[n].address, blocks[n].bytes);
    if (!block) return false;
    for (std::string_view rest = *block; rest.size() >= kMessageHead;) {
      const std::uint64_t type = number(rest, 0, 2), bytes = number(rest, 2, 2), flags = number(rest, 4, 1);
      rest.remove_prefix(kMessageHead);
      if (bytes > rest.size()) return false;
      const std::string_view message = rest.substr(0, bytes);
      rest.remove_prefix(bytes);
      if (type == kContinuation && bytes >= 16) blocks.push_back({number(message, 0, 8), number(message, 8, 8)});
      if (type == kType && ((flags & kShared) != 0 || !is_sound_type(message))) return false;
      if (type != kLayout) continue;
      if ((flags & kShared) != 0 || !is_sound_layout(message)) return false;
      ++layouts;
    }
  }
  return layouts == 1;
}

// The heap whose header begins at `address`.
bool is_sound_heap(std::ifstream& file, std::uint64_t address, std::uint64_t file_bytes) {
  constexpr std::uint64_t kHeader = 32, kBlock = 16, kEnd = 1;  // bytes; the offset that ends the list
  const std::optional<std::string> header = bytes_at(file, address, kHeader);
  if (!header) return false;
  const std::uint64_t bytes = number(*header, 8, 8), data = number(*header, 24, 8);
  if (data > file_bytes || bytes > file_bytes - data) return false;
  std::uint64_t offset = number(*header, 16, 8);
  for (std::uint64_t left = bytes / kBlock + 1; offset != kEnd; --left) {
    if (left == 0 || bytes < kBlock || offset > bytes - kBlock) return false;
    const std::optional<std::string> block = bytes_at(file, data + offset, kBlock);
    if (!block || number(*block, 8, 8) > bytes - offset) return false;
    offset = number(*block, 0, 8);
  }
  return true;
}

}  // namespace

bool has_sound_heaps(const std::filesystem::path& path) {
  constexpr std::string_view kSignature = "HEAP";
  std::ifstream file(path, std::ios::binary);
  file.seekg(0, std::ios::end);
  const std::uint64_t bytes = file ? static_cast<std::uint64_t>(file.tellg()) : 0;
  // Parts overlap by what a signature may stand across.
  const std::uint64_t part = kMaxBlock - kSignature.size();
  for (std::uint64_t begin = 0; begin < bytes; begin += part) {
    const std::optional<std::string> text = bytes_at(file, begin, std::min(kMaxBlock, bytes - begin));
    if (!text) return false;
    for (std::size_t at = text->find(kSignature); at != std::string::npos && at < part;
         at = text->find(kSignature, at + 1)) {
      const std::uint64_t address = begin + at;
      if (address + 32 <= bytes && !is_sound_heap(file, address, bytes)) return false;
    }
  }
  return true;
}

namespace {

constexpr const char* kPath = "/df/table";
constexpr const char* kValues = "values_block_0";
// The columns of the index, as they stand in the rows of a written file.
constexpr std::array<const char*, 3> kIndex{"IWaveTheta", "IWavePhi", "Freq"};

// HDF5 identifier, closed by its destructor.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t), const std::string& what) : id_(id), close_(closer) {
    if (id_ < 0) throw InputError(what);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require(bool holds, const std::string& what) {
  if (!holds) throw InputError(what);
}

// HDF5 prints no errors, loads no filters and does not lock files, which some cluster file systems do not support.
Handle file_access() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "HDF5: no file access");
  require(H5Pset_file_locking(access, false, true) >= 0, "HDF5: no file access");
  return access;
}

// Place and kind of a number in the bytes of a row.
struct NumberPlace {
  std::size_t offset = 0, bytes = 0;
  bool is_integer = false, is_big_endian = false;

  double value(const char* row) const {
    std::array<char, 8> own{};
    std::copy_n(row + offset, bytes, own.begin());
    if (is_big_endian) std::reverse(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(bytes));
    if (is_integer) {
      return bytes == 8 ? static_cast<double>(std::bit_cast<std::int64_t>(own))
                        : std::bit_cast<std::array<std::int32_t, 2>>(own)[0];
    }
    return bytes == 8 ? std::bit_cast<double>(own) : double{std::bit_cast<std::array<float, 2>>(own)[0]};
  }
};

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie in memory");

// A number of this type at this offset; nothing if the type is no such number.
std::optional<NumberPlace> number_place(hid_t type, std::size_t offset) {
  const auto is = [&](hid_t other) { return H5Tequal(type, other) > 0; };
  if (is(H5T_IEEE_F64LE)) return NumberPlace{offset, 8, false, false};
  if (is(H5T_IEEE_F32LE)) return NumberPlace{offset, 4, false, false};
  if (is(H5T_IEEE_F64BE)) return NumberPlace{offset, 8, false, true};
  if (is(H5T_IEEE_F32BE)) return NumberPlace{offset, 4, false, true};
  if (is(H5T_STD_I64LE)) return NumberPlace{offset, 8, true, false};
  if (is(H5T_STD_I32LE)) return NumberPlace{offset, 4, true, false};
  return std::nullopt;
}

// A table of a file that is read, with the checks of what the file claims.
class ReadTable {
 public:
  ReadTable(const std::filesystem::path& file, std::string name)
      : name_(std::move(name)),
        file_(H5Fopen(file.c_str(), H5F_ACC_RDONLY, file_access()), H5Fclose,
              fmt::format("{}: not a whole HDF5 file (truncated or damaged)", name_)),
        set_(open(file)) {
    require_stored_here();
  }

  // The library copies the bytes: its conversions trust the offsets that a file claims.
  std::vector<PandasRow> rows() const {
    const std::string what = message("is damaged");
    const Handle type(H5Dget_type(set_), H5Tclose, what);
    const std::size_t bytes = H5Tget_size(type);
    const NumberPlace theta = index_place(type, kIndex[0]), phi = index_place(type, kIndex[1]),
                      frequency = index_place(type, kIndex[2]);
    const std::array<NumberPlace, 2> value = value_places(type);
    for (const NumberPlace& place : {theta, phi, frequency, value[0], value[1]})
      require(place.offset <= bytes && place.bytes <= bytes - place.offset, what);
    std::string content(count_ * bytes, '\0');
    if (count_ > 0)
      require(H5Dread(set_, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<void*>(content.data())) >= 0, what);
    std::vector<PandasRow> rows;
    rows.reserve(count_);
    for (const char* row = content.data(); rows.size() < count_; row += bytes) {
      rows.push_back(
          {frequency.value(row), theta.value(row), phi.value(row), {value[0].value(row), value[1].value(row)}});
    }
    return rows;
  }

 private:
  std::string message(std::string_view what) const { return fmt::format("{}: {} {}", name_, kPath, what); }

  Handle open(const std::filesystem::path& file) const {
    require(has_sound_heaps(file), fmt::format("{}: not a whole HDF5 file (damaged)", name_));
    for (const char* path : {"/df", kPath}) {
      H5L_info_t link;
      require(H5Lget_info(file_, path, &link, H5P_DEFAULT) >= 0,
              fmt::format("{}: no table {}, as pandas writes it with key=\"df\", format=\"table\"", name_, kPath));
      require(link.type == H5L_TYPE_HARD, message("is a link to another place"));
      if (path == std::string_view(kPath))
        require(has_sound_header(file, link.u.address), message("is no table or damaged"));
    }
    return Handle(H5Dopen2(file_, kPath, H5P_DEFAULT), H5Dclose, message("is no table or damaged"));
  }

  // One dimension, in one piece or in chunks, without filters, with as many bytes as its rows need.
  void require_stored_here() {
    const std::string damaged = message("is damaged");
    const Handle space(H5Dget_space(set_), H5Sclose, damaged);
    require(H5Sget_simple_extent_ndims(space) == 1, message("must have one dimension"));
    hsize_t count = 0;
    require(H5Sget_simple_extent_dims(space, &count, nullptr) == 1, damaged);
    const Handle properties(H5Dget_create_plist(set_), H5Pclose, damaged);
    const H5D_layout_t layout = H5Pget_layout(properties);
    require((layout == H5D_CHUNKED || layout == H5D_CONTIGUOUS) && H5Pget_external_count(properties) == 0,
            message("is stored outside this file or in a way that is not read"));
    require(H5Pget_nfilters(properties) == 0, message("is compressed: write it without complevel"));
    const Handle type(H5Dget_type(set_), H5Tclose, damaged);
    hsize_t chunk = 1;
    if (layout == H5D_CHUNKED) require(H5Pget_chunk(properties, 1, &chunk) == 1 && chunk > 0, damaged);
    hsize_t bytes = 0;
    require(H5Fget_filesize(file_, &bytes) >= 0, damaged);
    const double chunks = std::ceil(static_cast<double>(count) / static_cast<double>(chunk));
    const double needed = chunks * static_cast<double>(chunk) * static_cast<double>(H5Tget_size(type));
    require(H5Tget_size(type) > 0, damaged);
    require(needed <= static_cast<double>(bytes), message("claims more rows than the file has"));
    require(static_cast<double>(H5Dget_storage_size(set_)) >= needed, message("is incomplete"));
    count_ = static_cast<std::size_t>(count);
  }

  NumberPlace index_place(hid_t row, const char* column) const {
    require(H5Tget_class(row) == H5T_COMPOUND, message("must have named columns"));
    for (const H5T_class_t other : {H5T_VLEN, H5T_REFERENCE})
      require(H5Tdetect_class(row, other) == 0, message("must have columns of numbers"));
    const auto [type, offset] = member(row, column);
    const std::optional<NumberPlace> place = number_place(type, offset);
    require(place.has_value(), fmt::format("{}: column {} of {}: must have numbers", name_, column, kPath));
    return *place;
  }

  // Real and imaginary part of the only column of values, an array of one complex number or that number.
  std::array<NumberPlace, 2> value_places(hid_t row) const {
    const auto [values, offset] = member(row, kValues);
    if (H5Tget_class(values) != H5T_ARRAY) return complex_places(values, offset);
    hsize_t length = 0;
    require(H5Tget_array_ndims(values) == 1 && H5Tget_array_dims2(values, &length) == 1 && length == 1,
            fmt::format("{}: {} of {}: must be one column of values", name_, kValues, kPath));
    return complex_places(Handle(H5Tget_super(values), H5Tclose, message("is damaged")), offset);
  }

  std::array<NumberPlace, 2> complex_places(hid_t type, std::size_t offset) const {
    const std::string what = fmt::format("{}: {} of {}: must have complex numbers", name_, kValues, kPath);
    require(H5Tget_class(type) == H5T_COMPOUND, what);
    std::array<NumberPlace, 2> places;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto [part, inside] = member(type, k == 0 ? "r" : "i");
      const std::optional<NumberPlace> place = number_place(part, offset + inside);
      require(place && !place->is_integer, what);
      places[k] = *place;
    }
    return places;
  }

  std::pair<Handle, std::size_t> member(hid_t compound, const char* column) const {
    const int index = H5Tget_member_index(compound, column);
    require(index >= 0, fmt::format("{}: {} has no column {}", name_, kPath, column));
    const auto number = static_cast<unsigned>(index);
    return {Handle(H5Tget_member_type(compound, number), H5Tclose, message("is damaged")),
            H5Tget_member_offset(compound, number)};
  }

  std::string name_;
  Handle file_, set_;
  std::size_t count_ = 0;
};

}  // namespace

bool is_hdf5_file(const std::filesystem::path& file) {
  constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);
  std::array<char, kSignature.size()> first{};
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  std::ifstream stream(file, std::ios::binary);
  return stream.read(first.data(), first.size()) && std::string_view(first.data(), first.size()) == kSignature;
}

std::vector<PandasRow> read_pandas_table(const std::filesystem::path& file) {
  std::vector<PandasRow> rows = ReadTable(file, file.string()).rows();
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const PandasRow& row = rows[n];
    for (const double x : {row.frequency, row.theta_deg, row.phi_deg, row.value.real(), row.value.imag()})
      require(std::isfinite(x), fmt::format("{}: row {} of {}: must be finite numbers", file.string(), n, kPath));
  }
  return rows;
}

}  // namespace seaglint

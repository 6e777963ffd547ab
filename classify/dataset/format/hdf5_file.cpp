// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/hdf5_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include <cmath>
#include <functional>
#include <numeric>
#include "sim/core/process/error.h"

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

// Superblock of version 2 or 3 (HDF5 File Format Specification 3.0, section II.A): signature, version in byte 8,
// address of the end of the file in bytes 28 to 35, root group in 36 to 43, checksum in 44 to 47.
constexpr std::size_t kVersionAt = 8, kEndAt = 28, kRootAt = 36, kChecksumAt = 44, kSuperblock = 48;

std::optional<std::uint64_t> end_of_file(const Hdf5Image& image) {
  const std::string& bytes = image.bytes;
  if (bytes.size() < kSuperblock || !bytes.starts_with("\x89HDF") || bytes[kVersionAt] < 2) return std::nullopt;
  std::uint64_t end = 0;
  std::memcpy(&end, bytes.data() + kEndAt, sizeof end);
  return end;
}

bool has_bytes_of(const Hdf5Image& file, const Hdf5Image& written) {
  if (file.bytes.size() < kSuperblock || file.bytes.size() > written.bytes.size()) return false;
  const auto equal = [&](std::size_t first, std::size_t end) {
    return std::equal(file.bytes.begin() + first, file.bytes.begin() + end, written.bytes.begin() + first);
  };
  return equal(0, kEndAt) && equal(kRootAt, kChecksumAt) && equal(kSuperblock, file.bytes.size());
}

namespace {

// The system error in the description of an HDF5 error, ": No space left on device"; "" if it has none.
std::string system_reason(std::string_view description) {
  constexpr std::string_view kBefore = "error message = '";
  const std::size_t begin = description.find(kBefore);
  if (begin == std::string_view::npos) return "";
  const std::size_t from = begin + kBefore.size();
  return fmt::format(": {}", description.substr(from, description.find('\'', from) - from));
}

bool says_no_memory(std::string_view description) {
  for (const std::string_view known : {"memory allocation failed", "unable to allocate memory"}) {
    if (description.find(known) != std::string_view::npos) return true;
  }
  return false;
}

// Replaces every `from` by `to` in a name: HDF5 interprets %b in a name as a block number, %% as a percent sign.
std::string with_percents(const std::string& name, std::string_view from, std::string_view to) {
  std::string result;
  std::size_t begin = 0;
  for (std::size_t i = name.find(from); i != std::string::npos; i = name.find(from, begin)) {
    result.append(name, begin, i - begin).append(to);
    begin = i + from.size();
  }
  return result.append(name, begin);
}

// Throws WorkError with the system error in HDF5's error stack, "WHAT: No space left on device", or without one if no
// system call failed; std::bad_alloc when HDF5 had no memory.
[[noreturn]] void fail(const std::string& what) {
  std::string reason;
  const auto look = [](unsigned, const H5E_error2_t* error, void* found) -> herr_t {
    const std::string_view text = error->desc ? error->desc : "";
    if (says_no_memory(text)) return 1;
    if (std::string known = system_reason(text); !known.empty()) *static_cast<std::string*>(found) = std::move(known);
    return 0;
  };
  if (H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, look, &reason) > 0) throw std::bad_alloc();
  throw WorkError(what + reason);
}

// HDF5 identifier, closed by its destructor. `what` is the message if the call that created it failed.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t), const std::string& what) : id_(id), close_(closer) {
    if (id_ < 0) fail(what);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

  void close(const std::string& what) {
    const herr_t status = close_(std::exchange(id_, -1));
    if (status < 0) fail(what);
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require(herr_t status, const std::string& what) {
  if (status < 0) fail(what);
}

Handle text_type(std::size_t bytes, H5T_str_t padding) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "string type");
  require(H5Tset_size(type, bytes), "string size");
  require(H5Tset_strpad(type, padding), "string padding");
  require(H5Tset_cset(type, H5T_CSET_UTF8), "string encoding");
  return type;
}

Handle type_of(ArrayType element, bool on_disk) {
  if (element == ArrayType::kName) return text_type(kNameBytes, H5T_STR_NULLPAD);
  const auto type = [&] {
    if (element == ArrayType::kFloat) return on_disk ? H5T_IEEE_F32LE : H5T_NATIVE_FLOAT;
    if (element == ArrayType::kDouble) return on_disk ? H5T_IEEE_F64LE : H5T_NATIVE_DOUBLE;
    if (element == ArrayType::kInt64) return on_disk ? H5T_STD_I64LE : H5T_NATIVE_INT64;
    return on_disk ? H5T_STD_U16LE : H5T_NATIVE_UINT16;
  }();
  return Handle(H5Tcopy(type), H5Tclose, "type");
}

Handle space_of(const Dimensions& size, const std::string& what) {
  const std::vector<hsize_t> extent(size.begin(), size.end());
  return Handle(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose, what);
}

// Rows `first` to `first + count - 1` of a space.
void select_rows(hid_t space, const Dimensions& size, std::uint64_t first, std::uint64_t count,
                 const std::string& what) {
  std::vector<hsize_t> start(size.size(), 0), extent(size.begin(), size.end());
  start[0] = first;
  extent[0] = count;
  require(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr), what);
}

Dimensions size_of(hid_t set, const std::string& what) {
  const Handle space(H5Dget_space(set), H5Sclose, what);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0) throw WorkError(what);
  std::vector<hsize_t> size(static_cast<std::size_t>(rank));
  if (rank > 0) require(H5Sget_simple_extent_dims(space, size.data(), nullptr), what);
  return {size.begin(), size.end()};
}

void write_attribute(hid_t object, const std::string& name, const std::string& text) {
  const std::string what = fmt::format("cannot write attribute {}", name);
  const Handle type = text_type(text.size() + 1, H5T_STR_NULLTERM);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, what);
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
  require(H5Awrite(attribute, type, text.c_str()), what);
}

// Errors are reported by exceptions; HDF5 would print its error stack on stderr. Files are closed by their owners; at
// exit HDF5 would otherwise repeat writes that failed on a full disk, and crash. No filter of a file is loaded.
Handle file_access(bool in_memory) {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  require(H5Pset_file_locking(access, false, true), "file locking");
  constexpr std::size_t kStep = std::size_t{1} << 20;  // bytes by which a file in memory grows
  if (in_memory) require(H5Pset_fapl_core(access, kStep, false), "file in memory");
  return access;
}

// A name for a file in memory: HDF5 takes two open ones for one if they have one name.
std::string image_name() {
  static std::atomic<unsigned> images{0};
  return fmt::format("image {}", images++);
}

// In memory without a file.
Handle create_file(const std::filesystem::path* file, Hdf5Version version) {
  const Handle access = file_access(file == nullptr);
  const H5F_libver_t bound = version == Hdf5Version::k18 ? H5F_LIBVER_V18 : H5F_LIBVER_V110;
  require(H5Pset_libver_bounds(access, bound, bound), "file format");
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "file creation");
  require(H5Pset_obj_track_times(creation, false), "file creation");
  const std::string name = file ? file->string() : image_name();
  return Handle(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose, "cannot create");
}

// The image, which HDF5 copies, or without one the file.
Handle open_file(const std::filesystem::path& file, const Hdf5Image* image) {
  const Handle access = file_access(image != nullptr);
  if (image)
    require(H5Pset_file_image(access, const_cast<char*>(image->bytes.data()), image->bytes.size()), "file in memory");
  const std::string name = image ? image_name() : file.string();
  return Handle(H5Fopen(name.c_str(), H5F_ACC_RDONLY, access), H5Fclose,
                "not a whole HDF5 file (truncated or damaged)");
}

// Sets the value that is read if a source file of a virtual array is missing: none that could be mistaken for data.
void set_missing_value(hid_t properties, ArrayType element, const std::string& what) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr std::uint16_t kLargest16 = std::numeric_limits<std::uint16_t>::max();
  if (element == ArrayType::kFloat || element == ArrayType::kDouble)
    require(H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &kNaN), what);
  if (element == ArrayType::kUint16) require(H5Pset_fill_value(properties, H5T_NATIVE_UINT16, &kLargest16), what);
}

}  // namespace

struct Hdf5Writer::Open {
  Handle file;
  std::map<std::string, Handle> arrays;  // by path; closed before the file

  void close_arrays() {
    for (auto& [path, set] : arrays) set.close(fmt::format("cannot write {}", path));
    arrays.clear();
  }
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& file, Hdf5Version version)
    : open_(new Open{create_file(&file, version), {}}) {}

Hdf5Writer::Hdf5Writer(Hdf5Version version) : open_(new Open{create_file(nullptr, version), {}}) {}

Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::attribute(const std::string& name, const std::string& text) {
  write_attribute(open_->file, name, text);
}

void Hdf5Writer::group(const std::string& path) {
  const std::string what = fmt::format("cannot write {}", path);
  const Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, what);
  require(H5Pset_obj_track_times(properties, false), what);
  const Handle made(H5Gcreate2(open_->file, path.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose, what);
}

void Hdf5Writer::array(const std::string& path, ArrayType element, const Dimensions& size, const Dimensions& chunk,
                       const ArrayText& text) {
  const std::string what = fmt::format("cannot write {}", path);
  const Handle space = space_of(size, what), type = type_of(element, true);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  require(H5Pset_obj_track_times(properties, false), what);
  const std::vector<hsize_t> extent(chunk.begin(), chunk.end());
  require(H5Pset_chunk(properties, static_cast<int>(extent.size()), extent.data()), what);
  require(H5Pset_fletcher32(properties), what);
  Handle set(H5Dcreate2(open_->file, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, what);
  write_attribute(set, "units", text.units);
  write_attribute(set, "description", text.description);
  open_->arrays.emplace(path, std::move(set));
}

void Hdf5Writer::virtual_array(const std::string& path, ArrayType element, const Dimensions& size,
                               std::span<const VirtualSource> sources, const ArrayText& text) {
  const std::string what = fmt::format("cannot write {}", path);
  const Handle space = space_of(size, what), type = type_of(element, true);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  require(H5Pset_obj_track_times(properties, false), what);
  set_missing_value(properties, element, what);
  for (const VirtualSource& source : sources) {
    Dimensions part = size;
    part[0] = source.count;
    const Handle part_space = space_of(part, what);
    select_rows(space, size, source.first, source.count, what);
    require(H5Pset_virtual(properties, space, with_percents(source.file, "%", "%%").c_str(), path.c_str(), part_space),
            what);
  }
  require(H5Sselect_all(space), what);
  const Handle set(H5Dcreate2(open_->file, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose,
                   what);
  write_attribute(set, "units", text.units);
  write_attribute(set, "description", text.description);
}

void Hdf5Writer::write_bytes(const std::string& path, ArrayType element, std::uint64_t first, const void* values,
                             std::size_t count) {
  const std::string what = fmt::format("cannot write {}", path);
  const Handle& set = open_->arrays.at(path);
  Dimensions size = size_of(set, what);
  const std::uint64_t per_row = element_count(std::span(size).subspan(1));
  SEAGLINT_CHECK(per_row > 0 && count % per_row == 0 && first + count / per_row <= size[0],
                 fmt::format("{}: {} values from row {} of {}, {} each", path, count, first, size[0], per_row));
  const Handle file_space(H5Dget_space(set), H5Sclose, what);
  select_rows(file_space, size, first, count / per_row, what);
  size[0] = count / per_row;
  const Handle memory_space = space_of(size, what), type = type_of(element, false);
  require(H5Dwrite(set, type, memory_space, file_space, H5P_DEFAULT, values), what);
}

void Hdf5Writer::close() {
  open_->close_arrays();
  open_->file.close("closing failed");
}

Hdf5Image Hdf5Writer::image() {
  open_->close_arrays();
  require(H5Fflush(open_->file, H5F_SCOPE_GLOBAL), "file in memory");
  const ssize_t size = H5Fget_file_image(open_->file, nullptr, 0);
  Hdf5Image image{std::string(size > 0 ? static_cast<std::size_t>(size) : 0, '\0')};
  if (size < 0 || H5Fget_file_image(open_->file, image.bytes.data(), image.bytes.size()) != size)
    fail("file in memory");
  return image;
}

struct Hdf5Reader::Open {
  Handle file;
  bool may_be_virtual = false;
  std::map<std::string, Handle> arrays;  // by path, opened at first use

  const Handle& array(const std::string& path) {
    const auto known = arrays.find(path);
    if (known != arrays.end()) return known->second;
    const std::string missing = fmt::format("{} is missing or damaged", path);
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
      H5L_info_t link;
      require(H5Lget_info(file, path.substr(0, end).c_str(), &link, H5P_DEFAULT), missing);
      if (link.type != H5L_TYPE_HARD) throw WorkError(fmt::format("{} is a link to another place", path));
      if (end == std::string::npos) break;
    }
    Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, missing);
    const Handle properties(H5Dget_create_plist(set), H5Pclose, missing);
    const H5D_layout_t layout = H5Pget_layout(properties);
    const bool chunked = layout == H5D_CHUNKED && H5Pget_external_count(properties) == 0;
    if (!chunked && !(layout == H5D_VIRTUAL && may_be_virtual))
      throw WorkError(fmt::format("{} is not stored in chunks of this file", path));
    if (chunked) require_plain_chunks(set, properties, path);
    return arrays.emplace(path, std::move(set)).first->second;
  }

  // Throws unless the chunks have the checksum as their only filter and no more bytes, as their index claims, than
  // the array and the file have.
  void require_plain_chunks(hid_t set, hid_t properties, const std::string& path) const {
    const std::string what = fmt::format("{} is damaged", path);
    if (H5Pget_nfilters(properties) != 1 ||
        H5Pget_filter2(properties, 0, nullptr, nullptr, nullptr, 0, nullptr, nullptr) != H5Z_FILTER_FLETCHER32)
      throw WorkError(fmt::format("{} has other filters than the checksum", path));
    const Dimensions extent = size_of(set, what);
    std::vector<hsize_t> chunk(extent.size());
    if (H5Pget_chunk(properties, static_cast<int>(chunk.size()), chunk.data()) != static_cast<int>(extent.size()))
      fail(what);
    const Handle type(H5Dget_type(set), H5Tclose, what);
    constexpr std::size_t kChecksumBytes = 4;
    const double needed =
        chunked_bytes(extent, Dimensions(chunk.begin(), chunk.end()), H5Tget_size(type), kChecksumBytes);
    const auto claimed = static_cast<double>(H5Dget_storage_size(set));
    hsize_t bytes = 0;
    require(H5Fget_filesize(file, &bytes), what);
    if (claimed < needed) throw WorkError(fmt::format("{} is incomplete", path));
    if (claimed > needed || needed > static_cast<double>(bytes))
      throw WorkError(fmt::format("{} claims more bytes than it has", path));
  }
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file) : open_(new Open{open_file(file, nullptr), true, {}}) {}

Hdf5Reader::Hdf5Reader(const Hdf5Image& image) : open_(new Open{open_file({}, &image), false, {}}) {
  const std::uint64_t end = end_of_file(image).value_or(0);
  if (end != image.bytes.size())
    throw WorkError(fmt::format("{} bytes for a file of {}: appended to or damaged", image.bytes.size(), end));
}

Hdf5Reader::~Hdf5Reader() = default;

std::string Hdf5Reader::attribute(const std::string& name) const {
  const std::string what = fmt::format("attribute {} is damaged", name);
  const htri_t exists = H5Aexists(open_->file, name.c_str());
  require(exists < 0 ? -1 : 0, what);
  if (exists == 0) return "";
  const Handle attribute(H5Aopen(open_->file, name.c_str(), H5P_DEFAULT), H5Aclose, what);
  const Handle type(H5Aget_type(attribute), H5Tclose, what);
  const hsize_t bytes = H5Aget_storage_size(attribute);
  constexpr hsize_t kMax = 65536;  // size of an attribute in an object's header
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || bytes > kMax || bytes != H5Tget_size(type))
    throw WorkError(what);
  std::vector<char> text(bytes + 1, '\0');
  require(H5Aread(attribute, type, text.data()), what);
  return text.data();
}

bool Hdf5Reader::has(const std::string& path) const { return H5Lexists(open_->file, path.c_str(), H5P_DEFAULT) > 0; }

Dimensions Hdf5Reader::size(const std::string& path) const {
  return size_of(open_->array(path), fmt::format("{} has no size", path));
}

std::vector<VirtualSource> Hdf5Reader::sources(const std::string& path) const {
  const std::string what = fmt::format("{} is damaged", path);
  const Handle properties(H5Dget_create_plist(open_->array(path)), H5Pclose, what);
  std::vector<VirtualSource> sources;
  if (H5Pget_layout(properties) != H5D_VIRTUAL) return sources;
  std::size_t count = 0;
  require(H5Pget_virtual_count(properties, &count), what);
  for (std::size_t i = 0; i < count; ++i) {
    const auto text = [&](ssize_t (*get)(hid_t, std::size_t, char*, std::size_t)) {
      const ssize_t length = get(properties, i, nullptr, 0);
      if (length < 0) throw WorkError(what);
      std::string value(static_cast<std::size_t>(length) + 1, '\0');
      if (get(properties, i, value.data(), value.size()) < 0) throw WorkError(what);
      value.pop_back();
      return value;
    };
    if (text(H5Pget_virtual_dsetname) != path) throw WorkError(fmt::format("{} takes rows of another array", path));
    const Handle rows(H5Pget_virtual_vspace(properties, i), H5Sclose, what);
    const int rank = H5Sget_simple_extent_ndims(rows);
    if (rank < 1) throw WorkError(what);
    std::vector<hsize_t> first(static_cast<std::size_t>(rank)), last(first);
    require(H5Sget_select_bounds(rows, first.data(), last.data()), what);
    sources.push_back({with_percents(text(H5Pget_virtual_filename), "%%", "%"), first[0], last[0] - first[0] + 1});
  }
  return sources;
}

void Hdf5Reader::require_type(const std::string& path, ArrayType element) const {
  const Handle stored(H5Dget_type(open_->array(path)), H5Tclose, fmt::format("{} is damaged", path));
  if (H5Tequal(stored, type_of(element, true)) <= 0) throw WorkError(fmt::format("{} has another type", path));
}

std::size_t Hdf5Reader::checked_count(const std::string& path, ArrayType element, std::size_t rank) const {
  require_type(path, element);
  const Dimensions extent = size(path);
  if (extent.size() != rank) throw WorkError(fmt::format("{} has not {} dimensions", path, rank));
  constexpr double kMaxBytes = 1e15;  // reached only by a virtual array, whose extent nothing else limits
  if (chunked_bytes(extent, extent, element_bytes(element), 0) > kMaxBytes)
    throw WorkError(fmt::format("{} claims more bytes than it has", path));
  return element_count(extent);
}

void Hdf5Reader::checked_rows(const std::string& path, ArrayType element, std::uint64_t first,
                              std::uint64_t count) const {
  require_type(path, element);
  const Dimensions extent = size(path);
  if (extent.size() != 1 || first > extent[0] || count > extent[0] - first)
    throw WorkError(fmt::format("{} has no rows {} to {}", path, first, first + count));
}

void Hdf5Reader::read_bytes(const std::string& path, ArrayType element, std::uint64_t first, std::uint64_t count,
                            void* values) const {
  const std::string what = fmt::format("{} is damaged", path);
  const Handle& set = open_->array(path);
  Dimensions extent = size(path);
  const Handle file_space(H5Dget_space(set), H5Sclose, what);
  if (count == 0) return;
  select_rows(file_space, extent, first, count, what);
  extent[0] = count;
  const Handle memory_space = space_of(extent, what), type = type_of(element, false);
  require(H5Dread(set, type, memory_space, file_space, H5P_DEFAULT, values), what);
}

}  // namespace seaglint

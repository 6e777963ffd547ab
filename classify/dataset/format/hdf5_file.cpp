// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/hdf5_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

// The system error in HDF5's error stack, ": No space left on device"; "" if no system call failed.
std::string system_reason() {
  std::string reason;
  const auto look = [](unsigned, const H5E_error2_t* error, void* found) -> herr_t {
    constexpr std::string_view kBefore = "error message = '";
    const std::string_view text = error->desc ? error->desc : "";
    const std::size_t begin = text.find(kBefore);
    if (begin == std::string_view::npos) return 0;
    const std::size_t from = begin + kBefore.size();
    *static_cast<std::string*>(found) = fmt::format(": {}", text.substr(from, text.find('\'', from) - from));
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, look, &reason);
  return reason;
}

// HDF5 identifier, closed by its destructor. `what` is the message if the call that created it failed.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t), const std::string& what) : id_(id), close_(closer) {
    if (id_ < 0) throw WorkError(what + system_reason());
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

  void close(const std::string& what) {
    const herr_t status = close_(std::exchange(id_, -1));
    if (status < 0) throw WorkError(what + system_reason());
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require(herr_t status, const std::string& what) {
  if (status < 0) throw WorkError(what + system_reason());
}

// To be called before the first file. Errors are reported by exceptions; HDF5 would print its error stack on stderr.
// Files are closed by their owners; at exit HDF5 would otherwise repeat writes that failed on a full disk, and crash.
void prepare_library() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
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

std::uint64_t product(std::span<const std::uint64_t> factors) {
  return std::accumulate(factors.begin(), factors.end(), std::uint64_t{1}, std::multiplies<>());
}

void write_attribute(hid_t object, const std::string& name, const std::string& text) {
  const std::string what = fmt::format("cannot write attribute {}", name);
  const Handle type = text_type(text.size() + 1, H5T_STR_NULLTERM);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, what);
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
  require(H5Awrite(attribute, type, text.c_str()), what);
}

Handle file_access(Hdf5Version version) {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  const H5F_libver_t bound = version == Hdf5Version::k18 ? H5F_LIBVER_V18 : H5F_LIBVER_V110;
  require(H5Pset_libver_bounds(access, bound, bound), "file format");
  require(H5Pset_file_locking(access, false, true), "file locking");
  return access;
}

Handle create_file(const std::filesystem::path& file, Hdf5Version version) {
  prepare_library();
  const Handle access = file_access(version);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "file creation");
  require(H5Pset_obj_track_times(creation, false), "file creation");
  return Handle(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose, "cannot create");
}

Handle open_file(const std::filesystem::path& file) {
  prepare_library();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  require(H5Pset_file_locking(access, false, true), "file locking");
  return Handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), H5Fclose,
                "not a whole HDF5 file (truncated or damaged)");
}

// Sets the value that is read if a source file of a virtual array is missing: none that could be mistaken for data.
void set_missing_value(hid_t properties, ArrayType element, const std::string& what) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();
  constexpr std::uint16_t kLargest16 = std::numeric_limits<std::uint16_t>::max();
  if (element == ArrayType::kFloat || element == ArrayType::kDouble)
    require(H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &kNaN), what);
  if (element == ArrayType::kInt64) require(H5Pset_fill_value(properties, H5T_NATIVE_INT64, &kLargest), what);
  if (element == ArrayType::kUint16) require(H5Pset_fill_value(properties, H5T_NATIVE_UINT16, &kLargest16), what);
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

std::vector<std::string> unpacked(const std::vector<char>& text) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < text.size(); i += kNameBytes)
    names.emplace_back(text.data() + i, strnlen(text.data() + i, kNameBytes));
  return names;
}

std::size_t bytes_of(ArrayType element) {
  switch (element) {
    case ArrayType::kFloat: return sizeof(float);
    case ArrayType::kUint16: return sizeof(std::uint16_t);
    case ArrayType::kName: return kNameBytes;
    default: return sizeof(double);
  }
}

}  // namespace

std::string packed_names(std::span<const std::string> names) {
  std::string text(names.size() * kNameBytes, '\0');
  for (std::size_t i = 0; i < names.size(); ++i)
    std::memcpy(text.data() + i * kNameBytes, names[i].data(), std::min(names[i].size(), kNameBytes));
  return text;
}

struct Hdf5Writer::Open {
  Handle file;
  std::map<std::string, Handle> arrays;  // by path; closed before the file
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& file, Hdf5Version version)
    : open_(new Open{create_file(file, version), {}}) {}

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
  const std::uint64_t per_row = product(std::span(size).subspan(1));
  SEAGLINT_CHECK(per_row > 0 && count % per_row == 0 && first + count / per_row <= size[0],
                 fmt::format("{}: {} values from row {} of {}, {} each", path, count, first, size[0], per_row));
  const Handle file_space(H5Dget_space(set), H5Sclose, what);
  select_rows(file_space, size, first, count / per_row, what);
  size[0] = count / per_row;
  const Handle memory_space = space_of(size, what), type = type_of(element, false);
  require(H5Dwrite(set, type, memory_space, file_space, H5P_DEFAULT, values), what);
}

void Hdf5Writer::write_names(const std::string& path, std::uint64_t first, std::span<const std::string> names) {
  const std::string text = packed_names(names);
  write_bytes(path, ArrayType::kName, first, text.data(), names.size());
}

void Hdf5Writer::close() {
  for (auto& [path, set] : open_->arrays) set.close(fmt::format("cannot write {}", path));
  open_->arrays.clear();
  open_->file.close("closing failed");
}

struct Hdf5Reader::Open {
  Handle file;
  std::map<std::string, Handle> arrays;  // by path, opened at first use

  const Handle& array(const std::string& path) {
    const auto known = arrays.find(path);
    if (known != arrays.end()) return known->second;
    Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, fmt::format("{} is missing or damaged", path));
    return arrays.emplace(path, std::move(set)).first->second;
  }
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file) : open_(new Open{open_file(file), {}}) {}

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
  const std::size_t rank = size(path).size();
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
    std::vector<hsize_t> first(rank), last(rank);
    require(H5Sget_select_bounds(rows, first.data(), last.data()), what);
    sources.push_back(
        {with_percents(text(H5Pget_virtual_filename), "%%", "%"), first.at(0), last.at(0) - first.at(0) + 1});
  }
  return sources;
}

std::size_t Hdf5Reader::checked_count(const std::string& path, ArrayType element, std::size_t rank) const {
  const Dimensions extent = size(path);
  if (extent.size() != rank) throw WorkError(fmt::format("{} has not {} dimensions", path, rank));
  const double bytes = std::accumulate(extent.begin(), extent.end(), static_cast<double>(bytes_of(element)),
                                       [](double a, std::uint64_t b) { return a * static_cast<double>(b); });
  const Handle properties(H5Dget_create_plist(open_->array(path)), H5Pclose, fmt::format("{} is damaged", path));
  const bool elsewhere = H5Pget_layout(properties) == H5D_VIRTUAL;
  if (!elsewhere && bytes > static_cast<double>(H5Dget_storage_size(open_->array(path))))
    throw WorkError(fmt::format("{} is incomplete", path));
  return product(extent);
}

void Hdf5Reader::checked_rows(const std::string& path, std::uint64_t first, std::uint64_t count) const {
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
  if (count > 0) {
    select_rows(file_space, extent, first, count, what);
  } else {
    require(H5Sselect_none(file_space), what);
  }
  extent[0] = count;
  const Handle memory_space = space_of(extent, what), type = type_of(element, false);
  require(H5Dread(set, type, count > 0 ? memory_space : file_space, file_space, H5P_DEFAULT, values), what);
}

std::vector<std::string> Hdf5Reader::names(const std::string& path) const {
  const std::size_t count = checked_count(path, ArrayType::kName, 1);
  std::vector<char> text(count * kNameBytes);
  read_bytes(path, ArrayType::kName, 0, count, text.data());
  return unpacked(text);
}

std::vector<std::string> Hdf5Reader::names(const std::string& path, std::uint64_t first, std::uint64_t count) const {
  checked_rows(path, first, count);
  std::vector<char> text(count * kNameBytes);
  read_bytes(path, ArrayType::kName, first, count, text.data());
  return unpacked(text);
}

}  // namespace seaglint

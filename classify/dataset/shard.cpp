// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/shard.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>
#include <type_traits>

#include "sim/core/error.h"
#include "sim/core/file.h"

namespace seaglint {

namespace {

constexpr std::size_t kNameBytes = 64;  // of a target's name, zero-padded
constexpr const char* kCentreFields = "range_m, velocity_mps, amplitude_m";

// An HDF5 identifier that closes itself. `what` is said when the call that made it failed.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t), const std::string& what) : id_(id), close_(closer) {
    if (id_ < 0) throw WorkError(what);
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

  void close(const std::string& what) {
    const herr_t status = close_(id_);
    id_ = -1;
    if (status < 0) throw WorkError(what);
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require(herr_t status, const std::string& what) {
  if (status < 0) throw WorkError(what);
}

// Errors are reported by our own exceptions; HDF5 would print its stack on stderr.
void silence_library() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

Handle name_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "string type");
  require(H5Tset_size(type, kNameBytes), "string size");
  require(H5Tset_strpad(type, H5T_STR_NULLPAD), "string padding");
  require(H5Tset_cset(type, H5T_CSET_UTF8), "string encoding");
  return Handle(H5Tcopy(type), H5Tclose, "string type");
}

// Types on disk are fixed little-endian whatever the machine.
template <class T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint16_t>) return H5T_NATIVE_UINT16;
}

template <class T>
hid_t disk_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_IEEE_F32LE;
  if constexpr (std::is_same_v<T, double>) return H5T_IEEE_F64LE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_STD_I64LE;
  if constexpr (std::is_same_v<T, std::uint16_t>) return H5T_STD_U16LE;
}

void write_text_attribute(hid_t object, const char* name, const std::string& text) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "attribute type");
  require(H5Tset_size(type, text.size() + 1), "attribute size");
  require(H5Tset_cset(type, H5T_CSET_UTF8), "attribute encoding");
  Handle space(H5Screate(H5S_SCALAR), H5Sclose, "attribute space");
  Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "attribute");
  require(H5Awrite(attribute, type, text.c_str()), "attribute");
}

using Dimensions = std::vector<hsize_t>;

// A data set written whole, chunked with a checksum per chunk, with `units` and `description`.
void write_array(hid_t parent, const char* name, hid_t disk, hid_t memory, const Dimensions& size,
                 const Dimensions& chunk, const void* values, const std::string& units,
                 const std::string& description) {
  const std::string what = fmt::format("cannot write /{}", name);
  Handle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose, what);
  Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  require(H5Pset_obj_track_times(properties, false), what);
  require(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), what);
  require(H5Pset_fletcher32(properties), what);
  Handle set(H5Dcreate2(parent, name, disk, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, what);
  require(H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), what);
  write_text_attribute(set, "units", units);
  write_text_attribute(set, "description", description);
  set.close(what);
}

template <class T>
void write_values(hid_t parent, const char* name, const Dimensions& size, const Dimensions& chunk,
                  const std::vector<T>& values, const std::string& units, const std::string& description) {
  write_array(parent, name, disk_type<T>(), memory_type<T>(), size, chunk, values.data(), units, description);
}

Handle create_group(hid_t parent, const char* name) {
  Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "group");
  require(H5Pset_obj_track_times(properties, false), "group");
  return Handle(H5Gcreate2(parent, name, H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose,
                fmt::format("group /{}", name));
}

void write_columns(hid_t group, const std::vector<Sample>& samples) {
  const Dimensions size{samples.size()};
  for (const SampleColumn& column : sample_columns()) {
    std::visit(
        [&](auto member) {
          using T = std::remove_cvref_t<decltype(std::declval<SampleRecord>().*member)>;
          if constexpr (std::is_same_v<T, std::string>) {
            std::vector<char> text(samples.size() * kNameBytes, '\0');
            for (std::size_t i = 0; i < samples.size(); ++i) {
              const std::string& value = samples[i].record.*member;
              std::memcpy(text.data() + i * kNameBytes, value.data(), std::min(value.size(), kNameBytes));
            }
            const Handle type = name_type();
            write_array(group, column.name, type, type, size, size, text.data(), column.unit, column.description);
          } else {
            std::vector<T> values;
            for (const Sample& sample : samples) values.push_back(sample.record.*member);
            write_values(group, column.name, size, size, values, column.unit, column.description);
          }
        },
        column.member);
  }
}

void check_shapes(const Shard& shard, int max_centres) {
  SEAGLINT_CHECK(!shard.samples.empty() && max_centres >= 1, "a shard holds at least one sample and one centre");
  const Sample& first = shard.samples.front();
  for (const Sample& sample : shard.samples) {
    SEAGLINT_CHECK(sample.magnitude.size() == shard.axes.cells(),
                   fmt::format("{} cells, axes say {}", sample.magnitude.size(), shard.axes.cells()));
    SEAGLINT_CHECK(sample.complex_values.size() == first.complex_values.size() &&
                       (sample.complex_values.empty() || sample.complex_values.size() == 2 * shard.axes.cells()),
                   "complex maps for all samples or none");
    SEAGLINT_CHECK(!sample.hop_code.empty() && sample.hop_code.size() == first.hop_code.size(), "equal pulses");
  }
}

void write_file_content(const std::filesystem::path& file, const Shard& shard, int max_centres) {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  require(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), "file format");
  Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "file creation");
  require(H5Pset_obj_track_times(creation, false), "file creation");
  Handle h5(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose, "cannot create");
  write_text_attribute(h5, "format", "seaglint shard 1");

  const StoredAxes& axes = shard.axes;
  const hsize_t n = shard.samples.size(), rows = axes.velocity_mps.size(), columns = axes.range_m.size();
  {
    Handle group = create_group(h5, "axes");
    write_values(group, "range_m", {columns}, {columns}, axes.range_m, "m",
                 "range relative to the target's reference point, positive = farther");
    write_values(group, "velocity_mps", {rows}, {rows}, axes.velocity_mps, "m/s",
                 "radial velocity, positive = receding");
  }

  std::vector<float> maps, complex_maps;
  std::vector<std::uint16_t> codes;
  const hsize_t pulses = shard.samples.front().hop_code.size(), centres = static_cast<hsize_t>(max_centres);
  std::vector<float> centre_table(n * centres * 3, 0.0f);
  for (std::size_t i = 0; i < n; ++i) {
    const Sample& sample = shard.samples[i];
    maps.insert(maps.end(), sample.magnitude.begin(), sample.magnitude.end());
    complex_maps.insert(complex_maps.end(), sample.complex_values.begin(), sample.complex_values.end());
    codes.insert(codes.end(), sample.hop_code.begin(), sample.hop_code.end());
    for (std::size_t k = 0; k < std::min<std::size_t>(sample.centre_list.size(), centres); ++k) {
      std::copy(sample.centre_list[k].begin(), sample.centre_list[k].end(),
                centre_table.begin() + (i * centres + k) * 3);
    }
  }
  write_values(h5, "maps", {n, rows, columns}, {1, rows, columns}, maps, "m", "|RV|, [sample][velocity][range]");
  if (!complex_maps.empty()) {
    write_values(h5, "maps_complex", {n, rows, columns, 2}, {1, rows, columns, 2}, complex_maps, "m",
                 "RV, [sample][velocity][range][real, imaginary]");
  }
  write_values(h5, "hop_code", {n, pulses}, {1, pulses}, codes, "1", "carrier number of every pulse");
  write_values(h5, "centres", {n, centres, 3}, {1, centres, 3}, centre_table, "m, m/s, m", kCentreFields);
  {
    Handle group = create_group(h5, "samples");
    write_columns(group, shard.samples);
  }
  h5.close("closing failed");
}

// The size of a data set; the number of dimensions must be `rank`.
Dimensions size_of(hid_t set, int rank, const char* name) {
  Handle space(H5Dget_space(set), H5Sclose, fmt::format("/{} has no size", name));
  if (H5Sget_simple_extent_ndims(space) != rank) throw WorkError(fmt::format("/{} has not {} dimensions", name, rank));
  Dimensions size(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, size.data(), nullptr);
  return size;
}

// Memory is allocated for what the file can hold only: a chunked set with more bytes than its storage is refused.
template <class T>
std::vector<T> read_values(hid_t parent, const char* name, Dimensions& size, int rank) {
  Handle set(H5Dopen2(parent, name, H5P_DEFAULT), H5Dclose, fmt::format("/{} is missing or damaged", name));
  size = size_of(set, rank, name);
  const double bytes = std::accumulate(size.begin(), size.end(), static_cast<double>(sizeof(T)), std::multiplies<>());
  if (bytes > static_cast<double>(H5Dget_storage_size(set))) throw WorkError(fmt::format("/{} is incomplete", name));
  std::vector<T> values(static_cast<std::size_t>(bytes) / sizeof(T));
  require(H5Dread(set, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          fmt::format("/{} is damaged", name));
  return values;
}

std::vector<std::string> read_names(hid_t parent, const char* name) {
  Handle set(H5Dopen2(parent, name, H5P_DEFAULT), H5Dclose, fmt::format("/samples/{} is missing or damaged", name));
  const Dimensions size = size_of(set, 1, name);
  if (static_cast<double>(size[0]) * kNameBytes > static_cast<double>(H5Dget_storage_size(set))) {
    throw WorkError(fmt::format("/samples/{} is incomplete", name));
  }
  std::vector<char> text(size[0] * kNameBytes);
  const Handle type = name_type();
  require(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), fmt::format("/samples/{} is damaged", name));
  std::vector<std::string> names;
  for (std::size_t i = 0; i < size[0]; ++i) {
    const char* begin = text.data() + i * kNameBytes;
    names.emplace_back(begin, strnlen(begin, kNameBytes));
  }
  return names;
}

void expect(bool condition, const std::string& what) {
  if (!condition) throw WorkError(what);
}

Shard read_content(const std::filesystem::path& file) {
  Handle h5(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose,
            "not a whole HDF5 file (truncated or damaged)");
  Shard shard;
  Dimensions size;
  {
    Handle axes(H5Gopen2(h5, "axes", H5P_DEFAULT), H5Gclose, "/axes is missing");
    shard.axes.range_m = read_values<double>(axes, "range_m", size, 1);
    shard.axes.velocity_mps = read_values<double>(axes, "velocity_mps", size, 1);
  }
  const std::size_t cells = shard.axes.cells();
  const std::vector<float> maps = read_values<float>(h5, "maps", size, 3);
  const std::size_t n = size[0];
  expect(n > 0 && size[1] == shard.axes.velocity_mps.size() && size[2] == shard.axes.range_m.size(),
         "/maps does not fit the axes");
  shard.samples.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    shard.samples[i].magnitude.assign(maps.begin() + i * cells, maps.begin() + (i + 1) * cells);
  }
  if (H5Lexists(h5, "maps_complex", H5P_DEFAULT) > 0) {
    const std::vector<float> values = read_values<float>(h5, "maps_complex", size, 4);
    expect(values.size() == 2 * n * cells, "/maps_complex does not fit /maps");
    for (std::size_t i = 0; i < n; ++i) {
      shard.samples[i].complex_values.assign(values.begin() + 2 * i * cells, values.begin() + 2 * (i + 1) * cells);
    }
  }
  const std::vector<std::uint16_t> codes = read_values<std::uint16_t>(h5, "hop_code", size, 2);
  expect(size[0] == n, "/hop_code does not fit /maps");
  const std::size_t pulses = size[1];
  for (std::size_t i = 0; i < n; ++i) {
    shard.samples[i].hop_code.assign(codes.begin() + i * pulses, codes.begin() + (i + 1) * pulses);
  }
  const std::vector<float> centres = read_values<float>(h5, "centres", size, 3);
  expect(size[0] == n && size[2] == 3, "/centres does not fit /maps");
  const std::size_t most = size[1];

  Handle columns(H5Gopen2(h5, "samples", H5P_DEFAULT), H5Gclose, "/samples is missing");
  for (const SampleColumn& column : sample_columns()) {
    std::visit(
        [&](auto member) {
          using T = std::remove_cvref_t<decltype(std::declval<SampleRecord>().*member)>;
          std::vector<T> values;
          if constexpr (std::is_same_v<T, std::string>) {
            values = read_names(columns, column.name);
          } else {
            values = read_values<T>(columns, column.name, size, 1);
          }
          expect(values.size() == n, fmt::format("/samples/{} does not fit /maps", column.name));
          for (std::size_t i = 0; i < n; ++i) shard.samples[i].record.*member = values[i];
        },
        column.member);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t count = shard.samples[i].record.centres;
    expect(count >= 0, "/samples/centres is negative");
    for (std::size_t k = 0; k < std::min<std::size_t>(static_cast<std::size_t>(count), most); ++k) {
      const float* row = centres.data() + (i * most + k) * 3;
      shard.samples[i].centre_list.push_back({row[0], row[1], row[2]});
    }
  }
  return shard;
}

}  // namespace

std::string shard_name(std::size_t index) { return fmt::format("shard_{:05}.h5", index); }

void write_shard(const std::filesystem::path& file, const Shard& shard, int max_centres) {
  check_shapes(shard, max_centres);
  for (const Sample& sample : shard.samples) {
    if (sample.record.target_name.size() > kNameBytes) {
      throw InputError(
          fmt::format("targets.{}: the name has more than {} bytes", sample.record.target_name, kNameBytes));
    }
  }
  silence_library();
  write_file_with(file, [&](const std::filesystem::path& temporary) {
    try {
      write_file_content(temporary, shard, max_centres);
    } catch (const WorkError& error) {
      throw WorkError(fmt::format("{}: {}", file.string(), error.what()));
    }
  });
}

Shard read_shard(const std::filesystem::path& file) {
  silence_library();
  if (!std::filesystem::is_regular_file(file)) throw InputError(fmt::format("{}: no such shard", file.string()));
  try {
    return read_content(file);
  } catch (const WorkError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace seaglint

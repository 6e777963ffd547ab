// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/export.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "classify/dataset/directory/file_names.h"
#include "classify/dataset/format/checksum.h"
#include "classify/dataset/format/drawn_columns.h"
#include "classify/dataset/format/hdf5_file.h"
#include "classify/dataset/format/layout.h"
#include "classify/dataset/format/npz.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/temporary_file.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

using nlohmann::ordered_json;

constexpr const char* kDescription = "description.json";

std::string name_of(const std::string& path) { return path.substr(1); }

struct Range {
  const DatasetReader& reader;
  std::size_t first = 0, count = 0;  // shards
  const StopFlag* stop = nullptr;

  fs::path file(std::size_t i) const { return reader.directory() / reader.manifest().shards[first + i].file; }
};

// NpzArray whose rows are read shard by shard on demand.
template <class T>
NpzArray streamed(const Range& range, const StoredArray& array, const char* type, Dimensions shape) {
  const std::size_t rank = shape.size() + (std::string_view(type) == "<c8" ? 1 : 0);
  const auto next = [range, path = array.path, rank, i = std::size_t{0}]() mutable {
    if (i == range.count) return std::string();
    if (range.stop && *range.stop) throw Interrupted();
    const Hdf5Reader shard(load_shard(range.file(i++)).image);
    const std::vector<T> values = shard.read<T>(path, rank).values;
    return bytes_of_values(std::span(values));
  };
  return {name_of(array.path), type, std::move(shape), next};
}

template <class T>
std::string column_bytes(const std::vector<SampleRecord>& rows, T SampleRecord::*member) {
  std::vector<T> values;
  for (const SampleRecord& row : rows) values.push_back(row.*member);
  if constexpr (std::is_same_v<T, std::string>) {
    return packed_names(values);
  } else {
    return bytes_of_values(std::span<const T>(values));
  }
}

// Manifest checksum of the data set that an archive was exported from; empty if it is no export.
std::string exported_manifest(const fs::path& file) {
  try {
    return nlohmann::json::parse(read_npz_text(file, kDescription)).at("manifest_sha256").get<std::string>();
  } catch (const InputError&) {
    return {};
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

// Content of description.json: the attributes of the HDF5 files.
std::string description(const Range& range, const std::set<std::string>& processors, bool complex_maps,
                        const DrawnKeys& keys) {
  ordered_json json;
  json["format"] = "seaglint npz 1";
  json["program_version"] = range.reader.manifest().program_version;
  json["processors"] = processors;
  json["manifest_sha256"] = sha256_file(range.reader.directory() / kManifestFile);
  const std::vector<std::string>& classes = range.reader.manifest().classes;
  if (classes != default_classes()) json["classes"] = classes;
  const auto add = [&](const std::string& path, const ArrayText& text) {
    json["arrays"][name_of(path)] = {{"units", text.units}, {"description", text.description}};
  };
  for (const StoredArray& array : {kRangeAxis, kVelocityAxis, kMaps, kHopCodes, kCentres})
    add(array.path, array.text());
  if (complex_maps) add(kComplexMaps.path, {kComplexMaps.units, "RV, [sample][velocity][range]"});
  for (const SampleColumn& column : sample_columns()) add(column_path(column), column_text(column, classes));
  for (const std::string& key : keys.numbers) add(drawn_path(key), drawn_text(key));
  for (const std::string& key : keys.words) add(drawn_path(key), drawn_text(key));
  return json.dump(2) + "\n";
}

}  // namespace

void export_shards(const DatasetReader& reader, std::size_t first, std::size_t count, const fs::path& file,
                   const StopFlag* stop) {
  const Range range{reader, first, count, stop};
  std::vector<SampleRecord> rows;
  std::set<std::string> processors;
  StoredAxes axes;
  bool complex_maps = false;
  for (std::size_t i = 0; i < count; ++i) {
    if (stop && *stop) throw Interrupted();
    const Shard shard = reader.shard(first + i);
    axes = shard.axes;
    complex_maps = !shard.samples.front().complex_values.empty();
    processors.insert(shard.origin.processor);
    for (const Sample& sample : shard.samples) rows.push_back(sample.record);
  }

  const std::uint64_t n = rows.size(), velocities = axes.velocity_mps.size(), ranges = axes.range_m.size();
  std::vector<NpzArray> arrays;
  const auto add_axis = [&](const StoredArray& axis, const std::vector<double>& values) {
    arrays.push_back(npz_array(name_of(axis.path), "<f8", {values.size()}, bytes_of_values(std::span(values))));
  };
  add_axis(kRangeAxis, axes.range_m);
  add_axis(kVelocityAxis, axes.velocity_mps);
  arrays.push_back(streamed<float>(range, kMaps, "<f4", {n, velocities, ranges}));
  if (complex_maps) arrays.push_back(streamed<float>(range, kComplexMaps, "<c8", {n, velocities, ranges}));
  const Hdf5Reader shard(load_shard(range.file(0)).image);
  arrays.push_back(streamed<std::uint16_t>(range, kHopCodes, "<u2", {n, shard.size(kHopCodes.path).at(1)}));
  arrays.push_back(streamed<float>(range, kCentres, "<f4", {n, shard.size(kCentres.path).at(1), 3}));
  for (const SampleColumn& column : sample_columns()) {
    std::visit(
        [&](auto member) {
          using T = typename MemberType<decltype(member)>::Type;
          arrays.push_back(
              npz_array(name_of(column_path(column)), numpy_type(array_type_of<T>()), {n}, column_bytes(rows, member)));
        },
        column.member);
  }
  const DrawnKeys keys = drawn_keys(rows.front());
  for (const SampleRecord& row : rows) {
    if (drawn_keys(row) != keys)
      throw InputError(fmt::format("{}: the shards have different drawn keys", reader.directory().string()));
  }
  for (std::size_t i = 0; i < keys.numbers.size(); ++i) {
    std::vector<double> values;
    for (const SampleRecord& row : rows) values.push_back(row.drawn_numbers[i].value);
    arrays.push_back(
        npz_array(name_of(drawn_path(keys.numbers[i])), "<f8", {n}, bytes_of_values(std::span<const double>(values))));
  }
  for (std::size_t i = 0; i < keys.words.size(); ++i) {
    std::vector<std::string> values;
    for (const SampleRecord& row : rows) values.push_back(row.drawn_words[i].value);
    arrays.push_back(
        npz_array(name_of(drawn_path(keys.words[i])), numpy_type(ArrayType::kName), {n}, packed_names(values)));
  }
  write_npz(file, arrays, {{kDescription, description(range, processors, complex_maps, keys)}});
}

void require_export_directory(const DatasetReader& reader, const fs::path& directory, const ExportedName& is_name,
                              const ExportedName& is_of_this_set) {
  if (!is_there(directory)) return;
  std::error_code error;
  if (!fs::is_directory(directory, error))
    throw InputError(fmt::format("{}: is a file, not a directory", directory.string()));
  if (fs::equivalent(directory, reader.directory(), error))
    throw InputError(fmt::format("{}: is the data set itself; export it into another directory", directory.string()));

  std::set<std::string> there;
  for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error))
    there.insert(it->path().filename());
  if (error) throw WorkError(fmt::format("{}: {}", directory.string(), error.message()));
  for (const std::string& name : there) {
    // Network file systems keep a file under a hidden name if it was removed while another process had it open.
    if (name.starts_with('.') || is_name(std::string(target_of_temporary(name)))) continue;
    if (is_name(name) && is_of_this_set(name)) continue;
    throw InputError(
        fmt::format("{}: the directory contains {}, which is not of this data set's export; choose a new directory",
                    directory.string(), name));
  }
}

void require_npz_directory(const DatasetReader& reader, const fs::path& directory) {
  std::set<std::string> ours;
  for (const ManifestShard& shard : reader.manifest().shards)
    ours.insert(fs::path(shard.file).replace_extension(".npz"));
  const std::string manifest = sha256_file(reader.directory() / kManifestFile);
  require_export_directory(
      reader, directory, [&](const std::string& name) { return ours.contains(name); },
      [&](const std::string& name) { return exported_manifest(directory / name) == manifest; });
}

}  // namespace seaglint

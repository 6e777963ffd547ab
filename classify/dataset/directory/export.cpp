// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/directory/dataset_writer.h"
#include "classify/dataset/format/hdf5_file.h"
#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/npz.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/progress.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFormat = "seaglint merged 2";
constexpr std::uint64_t kColumnChunk = 8192;  // rows; half a megabyte of names

// An array whose rows remain in the shards.
struct Virtual {
  StoredArray array;
  ArrayType element;
};
constexpr Virtual kVirtual[] = {{kMaps, ArrayType::kFloat},
                                {kComplexMaps, ArrayType::kFloat},
                                {kHopCodes, ArrayType::kUint16},
                                {kCentres, ArrayType::kFloat}};

// The folder of an existing or future file, without symbolic links.
fs::path folder_of(const fs::path& file) {
  std::error_code error;
  const fs::path resolved = fs::canonical(file, error);
  if (!error) return resolved.parent_path();
  return fs::weakly_canonical(file.has_parent_path() ? file.parent_path() : fs::path("."));
}

std::vector<VirtualSource> shard_sources(const DatasetReader& reader, const fs::path& file) {
  const fs::path shards = fs::canonical(reader.directory()).lexically_relative(folder_of(file));
  std::vector<VirtualSource> sources;
  for (const ManifestShard& shard : reader.manifest().shards)
    sources.push_back({(shards / shard.file).lexically_normal().string(), shard.first_sample, shard.samples});
  return sources;
}

// Throws InputError for shards beyond the plan and for HDF5 files of other origin.
void refuse_foreign_files(const fs::path& directory, std::size_t shards) {
  std::set<std::string> ours;
  for (std::size_t i = 0; i < shards; ++i) ours.insert(shard_name(i));
  for (const auto& entry : fs::directory_iterator(directory)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".h5" || ours.contains(file.filename()) || is_merged(file)) continue;
    throw InputError(fmt::format("{}: foreign: no shard of the scenario beside it", file.string()));
  }
}

// Throws InputError if an existing file that is no merged file, such as a shard, would be overwritten.
void require_own_place(const fs::path& file) {
  if (file.extension() != ".h5")
    throw InputError(fmt::format("{}: the name of a merged file ends in .h5", file.string()));
  if (fs::exists(file) && !is_merged(file))
    throw InputError(fmt::format("{}: exists and is no merged file; choose another name", file.string()));
}

void write_missing_manifest(const fs::path& directory, const Scenario& scenario, const SamplePlan& plan,
                            const std::string& program_version) {
  DatasetWriter writer(directory, scenario, plan, true, program_version);
  const std::vector<std::size_t> missing = writer.finish();
  if (missing.empty()) return;
  const fs::path file = directory / shard_name(missing.front());
  throw InputError(fmt::format("{}: {} ({} of {} shards); make it by `seaglint generate {} -o {} --resume`",
                               file.string(), fs::exists(file) ? "damaged or of another scenario" : "missing",
                               missing.size(), plan.shards(), (directory / kScenarioFile).string(),
                               directory.string()));
}

void require_same(const fs::path& file, const Shard& shard, const StoredAxes& axes, bool complex_maps,
                  const DrawnKeys& keys) {
  if (shard.axes != axes) throw InputError(fmt::format("{}: foreign: other axes than the first shard", file.string()));
  if (shard.samples.front().complex_values.empty() == complex_maps)
    throw InputError(fmt::format("{}: foreign: complex maps in some shards only", file.string()));
  for (const Sample& sample : shard.samples)
    if (drawn_keys(sample.record) != keys)
      throw InputError(fmt::format("{}: foreign: other drawn keys than the first shard", file.string()));
}

void write_merged(const DatasetReader& reader, const fs::path& temporary, const fs::path& file, const StopFlag* stop) {
  const Manifest& manifest = reader.manifest();
  Hdf5Writer merged(temporary, Hdf5Version::k110);
  merged.attribute("format", kFormat);
  merged.attribute("manifest_sha256", sha256_file(reader.directory() / kManifestFile));

  merged.group("/samples");
  const std::uint64_t chunk = std::min(manifest.samples, kColumnChunk);
  std::size_t looks = 1;
  StoredAxes axes;
  DrawnKeys keys;
  bool complex_maps = false;
  Progress progress("merging shards", reader.shards());
  for (std::size_t i = 0; i < reader.shards(); ++i) {
    if (stop && *stop) throw Interrupted();
    const Shard shard = reader.shard(i);
    if (i == 0) {
      keys = drawn_keys(shard.samples.front().record);
      axes = shard.axes;
      complex_maps = !shard.samples.front().complex_values.empty();
      looks = look_count(shard.samples.front());
    }
    require_same(reader.directory() / manifest.shards[i].file, shard, axes, complex_maps, keys);
    const StoredColumns table = stored_columns(shard.rows(), manifest.classes);
    if (i == 0) {
      for (const StoredColumn& column : table.samples) create_column(merged, column, manifest.samples, chunk);
      create_drawn(merged, table, manifest.samples, chunk);
    }
    for (const auto* columns : {&table.samples, &table.drawn})
      for (const StoredColumn& column : *columns) write_column(merged, column, manifest.shards[i].first_sample);
    if (looks > 1) {
      const std::vector<StoredColumn> of_looks = stored_look_columns(look_rows(shard.samples), manifest.classes);
      if (i == 0) merged.group("/looks");
      for (const StoredColumn& column : of_looks) {
        if (i == 0) create_column(merged, column, manifest.samples, chunk, looks);
        write_column(merged, column, manifest.shards[i].first_sample);
      }
    }
    progress.advance();
  }

  merged.group("/axes");
  const auto write_axis = [&](const StoredArray& axis, const std::vector<double>& values) {
    merged.array(axis.path, ArrayType::kDouble, {values.size()}, {values.size()}, axis.text());
    merged.write<double>(axis.path, 0, values);
  };
  write_axis(kRangeAxis, axes.range_m);
  write_axis(kVelocityAxis, axes.velocity_mps);
  const Hdf5Reader first(load_shard(reader.directory() / manifest.shards.front().file).image);
  const std::vector<VirtualSource> sources = shard_sources(reader, file);
  for (const auto& [array, element] : kVirtual) {
    if (!first.has(array.path)) continue;
    Dimensions whole = first.size(array.path);
    whole[0] = manifest.samples;
    merged.virtual_array(array.path, element, whole, sources, array.text());
  }
  merged.close();
}

}  // namespace

Merged merge_dataset(const fs::path& directory, const fs::path& file, const std::string& program_version,
                     const StopFlag* stop) {
  if (!fs::is_directory(directory)) throw InputError(fmt::format("{}: no such directory", directory.string()));
  require_own_place(file);
  const Scenario scenario = read_scenario(directory / kScenarioFile);
  const SamplePlan plan(scenario);
  refuse_foreign_files(directory, plan.shards());
  Merged result;
  result.wrote_manifest = !fs::exists(directory / kManifestFile);
  if (result.wrote_manifest) write_missing_manifest(directory, scenario, plan, program_version);

  const DatasetReader reader(directory);
  if (reader.shards() != plan.shards()) {
    throw InputError(fmt::format("{}: {} shards, the scenario has {}", (directory / kManifestFile).string(),
                                 reader.shards(), plan.shards()));
  }
  write_file_with(file, [&](const fs::path& temporary) {
    try {
      write_merged(reader, temporary, file, stop);
    } catch (const Interrupted&) {
      throw;
    } catch (const WorkError& error) {
      throw WorkError(fmt::format("{}: {}", file.string(), error.what()));
    }
  });
  remove_leftovers(file.parent_path(), file.filename().native());
  result.shards = reader.shards();
  result.samples = reader.size();
  return result;
}

bool is_merged(const fs::path& file) {
  try {
    return Hdf5Reader(file).attribute("format").starts_with("seaglint merged ");
  } catch (const WorkError&) {
    return false;
  }
}

fs::path data_set_of_merged(const fs::path& file) {
  if (!is_merged(file)) throw InputError(fmt::format("{}: is no merged file of a data set", file.string()));
  try {
    const Hdf5Reader merged(file);
    const std::vector<VirtualSource> sources = merged.sources(kMaps.path);
    if (sources.empty()) throw WorkError(fmt::format("{} is not an array over shards", kMaps.path));
    const fs::path directory = (folder_of(file) / sources.front().file).lexically_normal().parent_path();
    const fs::path manifest = directory / kManifestFile;
    if (!fs::exists(manifest)) throw WorkError(fmt::format("its shards are not in {}", directory.string()));
    if (merged.attribute("manifest_sha256") != sha256_file(manifest))
      throw WorkError(fmt::format("is of another manifest than {}; merge again", manifest.string()));
    return directory;
  } catch (const WorkError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

std::optional<std::string> merged_file_of_another_manifest(const DatasetReader& reader) {
  const fs::path file = reader.directory() / kMergedFile;
  if (!fs::is_regular_file(file) || !is_merged(file)) return std::nullopt;
  try {
    if (Hdf5Reader(file).attribute("manifest_sha256") == sha256_file(reader.directory() / kManifestFile))
      return std::nullopt;
  } catch (const WorkError& error) {
    return fmt::format("{}: {}; merge again", file.string(), error.what());
  }
  return fmt::format("{}: is of another manifest than the shards beside it; merge again or remove it", file.string());
}

MergedFileVerifier::MergedFileVerifier(fs::path file, const DatasetReader& reader)
    : file_(std::move(file)), reader_(&reader) {
  try {
    content_ = std::make_unique<Hdf5Reader>(file_);
    if (content_->attribute("format") != kFormat)
      throw WorkError(
          fmt::format("format \"{}\"; this program reads \"{}\"; merge again", content_->attribute("format"), kFormat));
    if (content_->attribute("manifest_sha256") != sha256_file(reader.directory() / kManifestFile))
      throw WorkError("is of another manifest; merge again");
    const Hdf5Reader first(load_shard(reader.directory() / reader.manifest().shards.front().file).image);
    const std::vector<VirtualSource> sources = shard_sources(reader, file_);
    for (const Virtual& expected : kVirtual) {
      const char* path = expected.array.path;
      if (content_->has(path) != first.has(path)) throw WorkError(fmt::format("{} is not as in the shards", path));
      if (!first.has(path)) continue;
      Dimensions whole = first.size(path);
      whole[0] = reader.size();
      if (content_->sources(path) != sources || content_->size(path) != whole)
        throw WorkError(fmt::format("{} does not take its rows from the shards", path));
    }
  } catch (const WorkError& error) {
    fault(error.what());
  } catch (const InputError& error) {
    fault(error.what());
  }
}

MergedFileVerifier::~MergedFileVerifier() = default;
MergedFileVerifier::MergedFileVerifier(MergedFileVerifier&&) noexcept = default;

void MergedFileVerifier::compare(std::size_t index, const Shard& shard) {
  if (!content_) return;
  try {
    const std::uint64_t first_row = reader_->manifest().shards[index].first_sample, count = shard.samples.size();
    const std::vector<SampleRecord> stored = read_rows(*content_, first_row, count);
    for (std::size_t i = 0; i < count; ++i) {
      if (const std::string column = differing_column(stored[i], shard.samples[i].record); !column.empty())
        throw WorkError(fmt::format("{} of sample {} is not the shard's", column, first_row + i));
    }
    if (content_->read<double>(kRangeAxis.path, 1).values != shard.axes.range_m ||
        content_->read<double>(kVelocityAxis.path, 1).values != shard.axes.velocity_mps)
      throw WorkError("its axes are not the shards'");
  } catch (const WorkError& error) {
    fault(error.what());
  }
}

void MergedFileVerifier::fault(const std::string& what) {
  faults_.push_back(fmt::format("{}: {}", file_.filename().string(), what));
  content_.reset();
}

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
                        const StoredColumns& table) {
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
  for (const auto* columns : {&table.samples, &table.drawn})
    for (const StoredColumn& column : *columns) add(column.path, column.text);
  return json.dump(2) + "\n";
}

}  // namespace

NpzArray npz_column(const StoredColumn& column, Dimensions shape) {
  return std::visit(
      [&]<class T>(const std::vector<T>& values) {
        std::string bytes;
        if constexpr (std::is_same_v<T, std::string>) {
          bytes = packed_names(values);
        } else {
          bytes = bytes_of_values(std::span<const T>(values));
        }
        return npz_array(name_of(column.path), numpy_type(array_type_of<T>()), std::move(shape), std::move(bytes));
      },
      column.values);
}

void export_shards(const DatasetReader& reader, std::size_t first, std::size_t count, const fs::path& file,
                   const StopFlag* stop) {
  const Range range{reader, first, count, stop};
  std::vector<SampleRecord> rows, of_looks;
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
    std::ranges::move(look_rows(shard.samples), std::back_inserter(of_looks));
  }

  const std::uint64_t n = rows.size(), looks = of_looks.size() / n;
  std::vector<NpzArray> arrays;
  const auto add_axis = [&](const StoredArray& axis, const std::vector<double>& values) {
    arrays.push_back(npz_array(name_of(axis.path), "<f8", {values.size()}, bytes_of_values(std::span(values))));
  };
  add_axis(kRangeAxis, axes.range_m);
  add_axis(kVelocityAxis, axes.velocity_mps);
  const Hdf5Reader shard(load_shard(range.file(0)).image);
  const auto shape = [&](const StoredArray& array) {
    Dimensions size = shard.size(array.path);
    size.front() = n;
    return size;
  };
  arrays.push_back(streamed<float>(range, kMaps, "<f4", shape(kMaps)));
  if (complex_maps) arrays.push_back(streamed<float>(range, kComplexMaps, "<c8", shape(kMaps)));
  arrays.push_back(streamed<std::uint16_t>(range, kHopCodes, "<u2", shape(kHopCodes)));
  arrays.push_back(streamed<float>(range, kCentres, "<f4", shape(kCentres)));
  const DrawnKeys keys = drawn_keys(rows.front());
  for (const SampleRecord& row : rows) {
    if (drawn_keys(row) != keys)
      throw InputError(fmt::format("{}: the shards have different drawn keys", reader.directory().string()));
  }
  StoredColumns table = stored_columns(rows, reader.manifest().classes);
  for (const auto* columns : {&table.samples, &table.drawn})
    for (const StoredColumn& column : *columns) arrays.push_back(npz_column(column, {n}));
  std::vector<StoredColumn> look_table;
  if (looks > 1) look_table = stored_look_columns(of_looks, reader.manifest().classes);
  for (const StoredColumn& column : look_table) arrays.push_back(npz_column(column, {n, looks}));
  std::ranges::move(look_table, std::back_inserter(table.samples));
  write_npz(file, arrays, {{kDescription, description(range, processors, complex_maps, table)}});
}

void require_npz_directory(const DatasetReader& reader, const fs::path& directory) {
  if (!is_there(directory)) return;
  std::error_code error;
  if (!fs::is_directory(directory, error))
    throw InputError(fmt::format("{}: is a file, not a directory", directory.string()));
  if (fs::equivalent(directory, reader.directory(), error))
    throw InputError(fmt::format("{}: is the data set itself; export it into another directory", directory.string()));

  std::set<std::string> ours, there;
  for (const ManifestShard& shard : reader.manifest().shards)
    ours.insert(fs::path(shard.file).replace_extension(".npz"));
  const std::string manifest = sha256_file(reader.directory() / kManifestFile);
  for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error))
    there.insert(it->path().filename());
  if (error) throw WorkError(fmt::format("{}: {}", directory.string(), error.message()));
  for (const std::string& name : there) {
    // Network file systems keep a file under a hidden name if it was removed while another process had it open.
    if (name.starts_with('.') || ours.contains(std::string(target_of_temporary(name)))) continue;
    if (ours.contains(name) && exported_manifest(directory / name) == manifest) continue;
    throw InputError(
        fmt::format("{}: the directory contains {}, which is not of this data set's export; choose a new directory",
                    directory.string(), name));
  }
}

}  // namespace seaglint

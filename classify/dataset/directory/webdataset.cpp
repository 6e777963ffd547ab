// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/webdataset.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/directory/export.h"
#include "classify/dataset/format/layout.h"
#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/npz.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/progress.h"

namespace seaglint {
namespace {

constexpr std::uint64_t kBlock = 512, kRecord = 20 * kBlock;

constexpr std::uint64_t rounded_up(std::uint64_t bytes, std::uint64_t unit) { return (bytes + unit - 1) / unit * unit; }

// The 512 bytes before a file's content. Numbers are octal digits with a NUL behind them.
std::string header(const std::string& name, std::uint64_t size) {
  SEAGLINT_CHECK(!name.empty() && name.size() <= 100 && size < (std::uint64_t{1} << 33), name);
  std::string block(kBlock, '\0');
  const auto put = [&](std::size_t offset, std::string_view text) {
    std::copy(text.begin(), text.end(), block.begin() + static_cast<std::ptrdiff_t>(offset));
  };
  put(0, name);
  put(100, "0000644");                     // mode
  put(108, "0000000");                     // user
  put(116, "0000000");                     // group
  put(124, fmt::format("{:011o}", size));  // bytes of the content
  put(136, "00000000000");                 // time of modification
  put(148, "        ");                    // checksum, as which blanks are summed
  put(156, "0");                           // a regular file
  put(257, "ustar");
  put(263, "00");       // version
  put(329, "0000000");  // device numbers
  put(337, "0000000");
  const unsigned sum = std::accumulate(block.begin(), block.end(), 0u, [](unsigned total, char byte) {
    return total + static_cast<unsigned char>(byte);
  });
  put(148, fmt::format("{:06o}", sum));
  block[154] = '\0';  // then the blank at 155 that stands there
  return block;
}

}  // namespace

void TarWriter::add(const std::string& name, std::string_view content) {
  append(header(name, content.size()));
  append(content);
  append(std::string(rounded_up(content.size(), kBlock) - content.size(), '\0'));
}

void TarWriter::finish() { append(std::string(archive_bytes(bytes_) - bytes_, '\0')); }

std::uint64_t TarWriter::member_bytes(std::uint64_t content_bytes) {
  return kBlock + rounded_up(content_bytes, kBlock);
}

std::uint64_t TarWriter::archive_bytes(std::uint64_t bytes) { return rounded_up(bytes + 2 * kBlock, kRecord); }

void TarWriter::append(std::string_view part) {
  append_(part);
  bytes_ += part.size();
}

namespace fs = std::filesystem;

namespace {

using nlohmann::ordered_json;

constexpr const char* kFormat = "seaglint webdataset 1";
constexpr const char* kDescription = "description.json";
constexpr const char* kIndex = "index.json";
constexpr const char* kBefore = "samples-";
constexpr const char* kAfter = ".tar";
constexpr int kKeyDigits = 9;                                       // a data set has at most 10^9 samples
constexpr std::uint64_t kMaxDescription = std::uint64_t{16} << 20;  // bytes

std::string archive_name(std::size_t number) { return fmt::format("{}{:06}{}", kBefore, number, kAfter); }

bool is_archive_name(std::string_view name) {
  if (!name.starts_with(kBefore) || !name.ends_with(kAfter)) return false;
  name.remove_prefix(std::string_view(kBefore).size());
  name.remove_suffix(std::string_view(kAfter).size());
  return name.size() >= 6 && std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool is_exported_name(const std::string& name) {
  return name == kDescription || name == kIndex || is_archive_name(name);
}

// The files of one sample, in the order of an archive.
using Members = std::vector<std::pair<std::string, std::string>>;  // name, content

std::uint64_t bytes_of(const Members& members) {
  std::uint64_t bytes = 0;
  for (const auto& [name, content] : members) bytes += TarWriter::member_bytes(content.size());
  return bytes;
}

std::string row_json(const SampleRecord& record) {
  ordered_json row;
  for (const SampleColumn& column : sample_columns())
    std::visit([&](auto member) { row[column.name] = record.*member; }, column.member);
  visit_drawn(record, [&](const std::string& key, const auto& value) { row[key] = value; });
  return row.dump() + "\n";
}

Members members_of(const Sample& sample, const StoredAxes& axes) {
  const std::string key = fmt::format("{:0{}}.", sample.record.sample, kKeyDigits);
  const Dimensions map{axes.velocity_mps.size(), axes.range_m.size()}, pulses{sample.hop_code.size()},
      centres{sample.centre_list.size(), 3};
  Members members;
  members.emplace_back(key + "map.npy", npy_file(map, std::span(sample.magnitude), "<f4"));
  if (!sample.complex_values.empty())
    members.emplace_back(key + "complex.npy", npy_file(map, std::span(sample.complex_values), "<c8"));
  members.emplace_back(key + "hop_code.npy", npy_file(pulses, std::span(sample.hop_code), "<u2"));
  members.emplace_back(key + "centres.npy", npy_file(centres, std::span(sample.centre_list), "<f4"));
  members.emplace_back(key + "cls", fmt::format("{}", sample.record.label));
  members.emplace_back(key + "json", row_json(sample.record));
  return members;
}

// The samples of a data set one after the other, of which one shard is in memory.
class SampleSource {
 public:
  SampleSource(const DatasetReader& reader, const StopFlag* stop)
      : reader_(reader), stop_(stop), progress_("exporting shards", reader.shards()) {
    advance();
  }

  const std::optional<Members>& current() const { return current_; }

  void advance() {
    while (next_ == shard_.samples.size()) {
      if (index_ > 0) progress_.advance();
      if (index_ == reader_.shards()) {
        current_.reset();
        return;
      }
      shard_ = reader_.shard(index_++);
      next_ = 0;
    }
    if (stop_ && *stop_) throw Interrupted();
    current_ = members_of(shard_.samples[next_++], shard_.axes);
  }

 private:
  const DatasetReader& reader_;
  const StopFlag* stop_;
  Progress progress_;
  std::size_t index_ = 0;  // of the next shard
  std::size_t next_ = 0;   // in the shard
  Shard shard_;
  std::optional<Members> current_;
};

// Content of description.json.
std::string description(const DatasetReader& reader, const std::string& manifest_sha256) {
  const Shard first = reader.shard(0);
  ordered_json json;
  json["format"] = kFormat;
  json["program_version"] = reader.manifest().program_version;
  json["processors"] = reader.manifest().processors;
  json["manifest_sha256"] = manifest_sha256;
  if (reader.manifest().classes != default_classes()) json["classes"] = reader.manifest().classes;
  json["samples"] = reader.size();
  json["axes"] = {{"velocity_mps", first.axes.velocity_mps}, {"range_m", first.axes.range_m}};
  const auto add = [&](const char* name, const char* type, const StoredArray& array, const char* order) {
    json["files"][name] = {
        {"type", type}, {"order", order}, {"units", array.units}, {"description", array.description}};
  };
  add("map.npy", "float32", kMaps, "velocity, range");
  json["files"]["map.npy"]["description"] = "|RV|";
  if (!first.samples.front().complex_values.empty()) {
    add("complex.npy", "complex64", kComplexMaps, "velocity, range");
    json["files"]["complex.npy"]["description"] = "RV";
  }
  add("hop_code.npy", "uint16", kHopCodes, "pulse");
  add("centres.npy", "float32", kCentres, "centre, value; strongest first");
  for (const SampleColumn& column : sample_columns())
    json["columns"][column.name] = {{"units", column.unit},
                                    {"description", description_of(column, reader.manifest().classes)}};
  visit_drawn(first.samples.front().record, [&](const std::string& key, const auto&) {
    const ArrayText text = drawn_text(key);
    json["columns"][key] = {{"units", text.units}, {"description", text.description}};
  });
  return json.dump(2) + "\n";
}

// Manifest checksum of the data set whose export is in the directory; empty without one.
std::string exported_manifest(const fs::path& directory) {
  try {
    const auto json = nlohmann::json::parse(read_file(directory / kDescription, kMaxDescription));
    return json.at("format") == kFormat ? json.at("manifest_sha256").get<std::string>() : std::string();
  } catch (const InputError&) {
    return {};
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw WorkError(fmt::format("{}: cannot remove: {}", file.string(), error.message()));
}

void require_fits(const Members& members, std::uint64_t max_bytes) {
  const std::uint64_t alone = TarWriter::archive_bytes(bytes_of(members));
  if (alone > max_bytes)
    throw InputError(fmt::format("an archive of sample {} alone has {} bytes, more than the limit of {}",
                                 members.front().first.substr(0, kKeyDigits), alone, max_bytes));
}

// Writes the archive of the samples from the current one on; returns their number.
std::size_t write_archive(const fs::path& file, SampleSource& samples, std::uint64_t max_bytes) {
  std::size_t count = 0;
  write_blocks(file, [&](const AppendText& append) {
    TarWriter archive(append);
    while (samples.current()) {
      const Members& members = *samples.current();
      require_fits(members, max_bytes);
      if (TarWriter::archive_bytes(archive.bytes() + bytes_of(members)) > max_bytes) break;
      for (const auto& [name, content] : members) archive.add(name, content);
      ++count;
      samples.advance();
    }
    archive.finish();
  });
  return count;
}

}  // namespace

std::size_t export_webdataset(const DatasetReader& reader, const fs::path& directory, std::uint64_t max_bytes,
                              const StopFlag* stop) {
  const std::string manifest = sha256_file(reader.directory() / kManifestFile);
  const bool is_of_this_set = exported_manifest(directory) == manifest;
  require_export_directory(reader, directory, is_exported_name, [&](const std::string&) { return is_of_this_set; });
  SampleSource samples(reader, stop);
  require_fits(*samples.current(), max_bytes);
  make_directory(directory);
  remove_file(directory / kIndex);
  write_file(directory / kDescription, description(reader, manifest));

  ordered_json index;
  index["__kind__"] = "wids-shard-index-v1";
  index["wids_version"] = 1;
  index["name"] = reader.manifest().scenario;
  index["shardlist"] = ordered_json::array();
  std::size_t archives = 0;
  for (; samples.current(); ++archives) {
    const fs::path file = directory / archive_name(archives);
    const std::size_t count = write_archive(file, samples, max_bytes);
    index["shardlist"].push_back({{"url", archive_name(archives)},
                                  {"nsamples", count},
                                  {"filesize", fs::file_size(file)},
                                  {"sha256", sha256_file(file)}});
  }
  // Of an earlier export with smaller archives.
  for (std::size_t left = archives; fs::exists(directory / archive_name(left)); ++left)
    remove_file(directory / archive_name(left));
  write_file(directory / kIndex, index.dump(2) + "\n");
  remove_leftovers(directory);
  return archives;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Exports a data set in the WebDataset layout: tar archives samples-000000.tar, samples-000001.tar, ... in which the
// files of one sample are adjacent and have its number, nine digits, as the name before the first dot:
//
//   KEY.map.npy       float32 [velocity][range], m
//   KEY.complex.npy   complex64 [velocity][range], m; only with dataset.complex_maps
//   KEY.hop_code.npy  uint16 [pulse]
//   KEY.centres.npy   float32 [centre][range_m, velocity_mps, amplitude_m], strongest first
//   KEY.cls           the label, decimal
//   KEY.json          the row of the sample, {column: value}; null where a value is not a number
//
// description.json has axes, units and meaning, version and the manifest's SHA-256; index.json lists the archives with
// samples, bytes and SHA-256, as the package `wids` reads them. index.json is written last: an export without it is
// incomplete. The bytes depend only on the data set and max_bytes.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "classify/dataset/directory/dataset_reader.h"
#include "sim/core/process/file.h"
#include "sim/core/process/parallel.h"

namespace seaglint {

// Writes tar archives in the USTAR format (POSIX.1-1988): regular files of mode 0644 whose owner and times are zero, so
// that the bytes depend only on names and contents.
class TarWriter {
 public:
  explicit TarWriter(const AppendText& append) : append_(append) {}  // which lives as long as the writer

  // Appends a file. `name` has 1 to 100 bytes, `content` less than 8 GiB.
  void add(const std::string& name, std::string_view content);
  // Appends the end of the archive, padded to a multiple of 10 KiB as tar(1) does.
  void finish();

  // Bytes of the archive up to now, without its end.
  std::uint64_t bytes() const { return bytes_; }

  // Bytes that a file of this size takes in an archive, and those of an archive with `bytes` of such.
  static std::uint64_t member_bytes(std::uint64_t content_bytes);
  static std::uint64_t archive_bytes(std::uint64_t bytes);

 private:
  void append(std::string_view part);

  const AppendText& append_;
  std::uint64_t bytes_ = 0;
};

// Checks the directory by require_export_directory() and writes all files, each completely or not at all. An archive
// has at most max_bytes and at least one sample. Memory holds one shard. Returns the number of archives. Throws
// InputError for max_bytes too small for a sample and for a damaged shard, WorkError when a file cannot be written,
// Interrupted when *stop becomes true; finished archives remain.
std::size_t export_webdataset(const DatasetReader& reader, const std::filesystem::path& directory,
                              std::uint64_t max_bytes, const StopFlag* stop = nullptr);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A small data set in a directory of its own; its rows and maps are consistent with its scenario.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/directory/dataset_writer.h"
#include "sim/core/process/file.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {

inline constexpr const char* kTestVersion = "0.0.0";

// The name of a temporary file that no process holds.
inline std::string leftover_name(const std::string& file) { return file + ".0123456789abcdef.tmp"; }

class DataSetDirectory : public testing::Test {
 protected:
  Shard shard_of(std::size_t index) const {
    Shard shard;
    shard.origin = {kTestVersion, processor_kind()};
    shard.axes.range_m = {0, 1};
    shard.axes.velocity_mps = {0, 1};
    for (std::size_t i = 0; i < plan_.shard(index).count; ++i) {
      Sample sample;
      sample.record = planned_record(scenario_, plan_, plan_.shard(index).first + i);
      const auto last = 4 + static_cast<float>(sample.record.sample);
      sample.magnitude = {1, 2, 3, last};
      sample.record.peak_m = last;
      sample.record.energy_m2 = 14 + last * last;
      sample.hop_code = {1, 0};
      shard.samples.push_back(sample);
    }
    return shard;
  }

  void make_complete() {
    DatasetWriter writer(directory_, scenario_, false, kTestVersion);
    for (std::size_t i = 0; i < plan_.shards(); ++i) writer.put(i, shard_of(i));
    ASSERT_TRUE(writer.finish().empty());
  }

  // Messages with which the directory is refused.
  std::string unreadable() const {
    return refusal_of([&] { DatasetReader reader(directory_); });
  }
  std::string not_continued() const {
    return refusal_of([&] { DatasetWriter(directory_, scenario_, true, kTestVersion); });
  }
  // Changes a byte of a file.
  static void damage(const std::filesystem::path& file, std::size_t place) {
    std::string bytes = read_file(file);
    bytes.at(place) = static_cast<char>(bytes[place] ^ 1);
    write_file(file, bytes);
  }

  void make_manifest_again() { DatasetWriter(directory_, scenario_, true, kTestVersion).finish(); }

  const TemporaryFolder folder_;
  const std::filesystem::path directory_ = folder_.path() / "data";
  Scenario scenario_ = parse_scenario(R"(
seaglint: 1
name: small
targets:
  ship: {label: 1, points: [{position_m: [0, 0, 0]}]}
  array: {label: 0, points: [{position_m: [5, 0, 0]}]}
dataset: {maps_per_case: 4, realisations_per_case: 2, maps_per_shard: 3}
)",
                                      "small.yaml");
  SamplePlan plan_{scenario_};
};

}  // namespace seaglint

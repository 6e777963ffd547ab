// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A small data set in a directory of its own; its rows and maps are consistent with its scenario.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "classify/dataset/directory/dataset_writer.h"

namespace seaglint {

inline constexpr const char* kTestVersion = "0.0.0";

// The name of a temporary file that no process holds.
inline std::string leftover_name(const std::string& file) { return file + ".0123456789abcdef.tmp"; }

class DataSetDirectory : public testing::Test {
 protected:
  void SetUp() override {
    directory_ =
        std::filesystem::temp_directory_path() / ("seaglint_data_" + std::to_string(::getpid()) + "_" +
                                                  testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

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

  void make_manifest_again() { DatasetWriter(directory_, scenario_, true, kTestVersion).finish(); }

  std::filesystem::path directory_;
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

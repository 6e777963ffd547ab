// SPDX-License-Identifier: BSD-3-Clause
// The life of a data set directory: made, resumed, damaged, read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "classify/dataset/checksum.h"
#include "classify/dataset/dataset_reader.h"
#include "sim/core/error.h"
#include "sim/core/file.h"
#include "tests/classify/dataset/data_directory.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(DataDirectory, IsReadBackWhole) {
  make_whole();
  const DatasetReader reader(directory_);
  EXPECT_EQ(reader.size(), plan_.size());
  std::int64_t next = 0;
  for (std::size_t i = 0; i < reader.shards(); ++i) {
    for (const Sample& sample : reader.shard(i).samples) EXPECT_EQ(sample.record.sample, next++);
  }
  EXPECT_EQ(static_cast<std::size_t>(next), plan_.size());
  EXPECT_EQ(read_scenario(directory_ / kScenarioFile).dataset.maps_per_case, 4);
  EXPECT_THAT(read_file(directory_ / kDataCardFile), HasSubstr("| ship | 1 |"));
}

TEST_F(DataDirectory, IsNotWholeUntilTheLastShardIsThere) {
  DatasetWriter writer(directory_, scenario_, false);
  writer.put(0, shard_of(0));
  EXPECT_EQ(writer.finish("0.0.0"), plan_.shards() - 1);
  EXPECT_THAT(error_of([&] { DatasetReader reader(directory_); }), HasSubstr("no manifest.json"));
}

TEST_F(DataDirectory, ThatIsNotEmptyNeedsResume) {
  make_whole();
  EXPECT_THAT(error_of([&] { DatasetWriter(directory_, scenario_, false); }), HasSubstr("--resume"));
  EXPECT_NO_THROW(DatasetWriter(directory_, scenario_, true));
}

TEST_F(DataDirectory, OfAnotherScenarioIsRefusedWithTheFirstDifference) {
  make_whole();
  Scenario other = scenario_;
  other.seed = 43;
  EXPECT_THAT(error_of([&] { DatasetWriter(directory_, other, true); }),
              HasSubstr("`seed: 42` there, `seed: 43` here"));
}

TEST_F(DataDirectory, KeepsItsMapsWhenOnlyLearningChanges) {
  make_whole();
  Scenario other = scenario_;
  other.learning.epochs = 7;
  other.dataset.train_share = 0.5;
  EXPECT_TRUE(DatasetWriter(directory_, other, true).complete(0));
  EXPECT_EQ(read_scenario(directory_ / kScenarioFile).learning.epochs, 7);
}

TEST_F(DataDirectory, ResumesOnlyWhatIsUnsound) {
  make_whole();
  fs::remove(directory_ / kManifestFile);
  fs::resize_file(directory_ / shard_name(1), fs::file_size(directory_ / shard_name(1)) - 10);
  fs::remove(directory_ / shard_name(2));
  const DatasetWriter writer(directory_, scenario_, true);
  EXPECT_TRUE(writer.complete(0));
  EXPECT_FALSE(writer.complete(1));
  EXPECT_FALSE(writer.complete(2));
}

TEST_F(DataDirectory, WithAChangedShardIsRefusedWithTheFilesName) {
  make_whole();
  const fs::path file = directory_ / shard_name(1);
  std::string bytes = read_file(file);
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  write_file(file, bytes);
  EXPECT_THAT(error_of([&] { DatasetReader(directory_).shard(1); }), HasSubstr("shard_00001.h5: truncated or changed"));
  EXPECT_FALSE(DatasetWriter(directory_, scenario_, true).complete(1));
  fs::remove(file);
  EXPECT_THAT(error_of([&] { DatasetReader reader(directory_); }), HasSubstr("shard_00001.h5: missing"));
}

TEST_F(DataDirectory, WithABrokenManifestIsRefused) {
  make_whole();
  const std::string good = read_file(directory_ / kManifestFile);
  const auto refused = [&](const std::string& manifest) {
    write_file(directory_ / kManifestFile, manifest);
    return error_of([&] { DatasetReader reader(directory_); });
  };
  EXPECT_THAT(refused(good.substr(0, good.size() / 2)), HasSubstr("manifest.json"));
  EXPECT_THAT(refused("[]"), HasSubstr("manifest.json"));
  EXPECT_THAT(refused("{\"format\": \"other\"}"), HasSubstr("format"));
  std::string outside = good;
  outside.replace(outside.find("shard_00000.h5"), 14, "../secret.h5");
  EXPECT_THAT(refused(outside), HasSubstr("is not the name of a file beside it"));
}

}  // namespace
}  // namespace seaglint

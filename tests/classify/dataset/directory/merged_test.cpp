// SPDX-License-Identifier: BSD-3-Clause
// One virtual file over all shards: it returns the shards' data and is not written over shards that are missing,
// damaged or foreign.
#include "classify/dataset/directory/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "classify/dataset/directory/audit.h"
#include "classify/dataset/format/hdf5_file.h"
#include "classify/dataset/format/layout.h"
#include "classify/dataset/format/manifest.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/classify/dataset/data_directory.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class MergedDataSet : public DataSetDirectory {
 protected:
  void SetUp() override {
    DataSetDirectory::SetUp();
    make_complete();
  }

  std::string refusal() const {
    try {
      merge_dataset(directory_, file(), kTestVersion);
    } catch (const InputError& error) {
      EXPECT_FALSE(fs::exists(file()));
      return error.what();
    }
    return "not refused";
  }

  void merge() const { merge_dataset(directory_, file(), kTestVersion); }
  fs::path file() const { return directory_ / kMergedFile; }
};

TEST_F(MergedDataSet, HasTheRowsOfItsShards) {
  merge();
  const Hdf5Reader merged(file());
  EXPECT_EQ(merged.size("/maps"), (Dimensions{plan_.size(), 2, 2}));
  EXPECT_THAT(merged.sources("/maps"),
              ElementsAre(VirtualSource{"shard_00000.h5", 0, 3}, VirtualSource{"shard_00001.h5", 3, 3},
                          VirtualSource{"shard_00002.h5", 6, 2}));
  const auto last = static_cast<std::int64_t>(plan_.size()) - 1;
  EXPECT_THAT(merged.rows<std::int64_t>("/samples/sample", 0, plan_.size()).back(), last);
  EXPECT_EQ(merged.names("/samples/target_name", 6, 1)[0], shard_of(2).samples[0].record.target_name);
  EXPECT_EQ(merged.read<double>("/axes/range_m", 1).values, shard_of(0).axes.range_m);
}

TEST_F(MergedDataSet, HasTheSameBytesWheneverItIsWritten) {
  merge();
  const std::string first = read_file(file());
  timespec pause{1, 100000000};  // longer than the resolution of a time stamp in whole seconds
  nanosleep(&pause, nullptr);
  merge();
  EXPECT_EQ(read_file(file()), first);
}

TEST_F(MergedDataSet, WritesAManifestMissingAfterConcurrentParts) {
  const std::string manifest = read_file(directory_ / kManifestFile);
  fs::remove(directory_ / kManifestFile);
  EXPECT_TRUE(merge_dataset(directory_, file(), kTestVersion).wrote_manifest);
  EXPECT_EQ(read_file(directory_ / kManifestFile), manifest);
}

TEST_F(MergedDataSet, IsRefusedWhereAShardIsMissing) {
  fs::remove(directory_ / shard_name(1));
  EXPECT_THAT(refusal(), HasSubstr("shard_00001.h5: missing"));
  fs::remove(directory_ / kManifestFile);
  EXPECT_THAT(refusal(), HasSubstr("shard_00001.h5: missing (1 of 3 shards)"));
}

TEST_F(MergedDataSet, IsRefusedWhereAShardIsDamaged) {
  const fs::path shard = directory_ / shard_name(1);
  std::string bytes = read_file(shard);
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  write_file(shard, bytes);
  EXPECT_THAT(refusal(), HasSubstr("shard_00001.h5: truncated or changed"));
  fs::resize_file(shard, fs::file_size(shard) - 1);
  fs::remove(directory_ / kManifestFile);
  EXPECT_THAT(refusal(), HasSubstr("shard_00001.h5: damaged or of another scenario"));
}

TEST_F(MergedDataSet, IsRefusedWhereAShardIsForeign) {
  const fs::path more = directory_ / "shard_00003.h5";
  fs::copy_file(directory_ / shard_name(0), more);
  EXPECT_THAT(refusal(), HasSubstr("shard_00003.h5: foreign"));
  fs::remove(more);
  Shard other = shard_of(1);
  for (Sample& sample : other.samples) sample.record.seed = 43;
  write_shard(directory_ / shard_name(1), other, scenario_.features.max_centres);
  EXPECT_THAT(refusal(), HasSubstr("shard_00001.h5: truncated or changed"));
  fs::remove(directory_ / kManifestFile);
  EXPECT_THAT(refusal(), HasSubstr("shard_00001.h5: damaged or of another scenario"));
}

TEST_F(MergedDataSet, IsRefusedWhereAShardIsOfAnotherVersion) {
  Shard other = shard_of(1);
  other.origin.program_version = "0.0.1";
  write_shard(directory_ / shard_name(1), other, scenario_.features.max_centres);
  fs::remove(directory_ / kManifestFile);
  EXPECT_THAT(refusal(), HasSubstr("shard_00001.h5: made by seaglint 0.0.1, this is seaglint 0.0.0"));
}

// What HDF5 returns for a shard that was removed later must not look like a map.
TEST_F(MergedDataSet, IsNaNWhereAShardIsMissing) {
  merge();
  fs::remove(directory_ / shard_name(1));
  const std::vector<float> maps = Hdf5Reader(file()).read<float>("/maps", 3).values;
  for (std::size_t i = 0; i < maps.size(); ++i) EXPECT_EQ(std::isnan(maps[i]), i / 4 >= 3 && i / 4 < 6) << i;
}

TEST_F(MergedDataSet, FindsItsShardsFromAnotherFolder) {
  // HDF5 reads %b in the name of a source as the number of a block.
  const fs::path other = directory_.string() + "_beside", moved = directory_.string() + "_50 %b";
  fs::remove_all(other);
  fs::remove_all(moved);
  fs::create_directories(other);
  fs::rename(directory_, moved);
  merge_dataset(moved, other / "all.h5", kTestVersion);
  {
    const Hdf5Reader merged(other / "all.h5");
    EXPECT_EQ(merged.sources("/maps").front().file, "../" + moved.filename().string() + "/shard_00000.h5");
    for (const float value : merged.read<float>("/maps", 3).values) EXPECT_FALSE(std::isnan(value));
  }
  fs::remove_all(other);
  fs::remove_all(moved);
}

TEST_F(MergedDataSet, PassesTheAudit) {
  merge();
  EXPECT_THAT(audit(directory_).faults, IsEmpty());
}

TEST_F(MergedDataSet, FailsTheAuditWhenItIsOfAnotherManifestOrDamaged) {
  merge();
  const std::string good = read_file(file());
  fs::resize_file(file(), good.size() / 2);
  EXPECT_THAT(audit(directory_).faults, ElementsAre(HasSubstr("dataset.h5: not in the manifest")));
  write_file(file(), good);
  Scenario other = scenario_;
  other.learning.epochs = 7;
  EXPECT_THAT(DatasetWriter(directory_, other, true, kTestVersion).finish(), IsEmpty());
  EXPECT_THAT(audit(directory_).faults, ElementsAre(HasSubstr("dataset.h5: is of another manifest; merge again")));
}

// It may be overwritten.
TEST_F(MergedDataSet, FailsTheAuditWhenItIsOfAnotherFormat) {
  merge();
  const std::string good = read_file(file());
  fs::remove(file());
  Hdf5Writer other(file(), Hdf5Version::k110);
  other.attribute("format", "seaglint merged 1");
  other.attribute("manifest_sha256", sha256_file(directory_ / kManifestFile));
  other.close();
  EXPECT_THAT(
      audit(directory_).faults,
      ElementsAre(HasSubstr("dataset.h5: format \"seaglint merged 1\"; this program reads \"seaglint merged 2\"; "
                            "merge again")));
  merge();
  EXPECT_EQ(read_file(file()), good);
}

TEST_F(MergedDataSet, FailsTheAuditWhenAnyByteOfARowIsChanged) {
  merge();
  std::string bytes = read_file(file());
  const std::string name = "ship";
  const std::size_t place = bytes.find(name + std::string(kNameBytes - name.size(), '\0'));
  ASSERT_NE(place, std::string::npos);
  bytes[place] = 'S';
  write_file(file(), bytes);
  EXPECT_THAT(audit(directory_).faults, ElementsAre(HasSubstr("dataset.h5: /samples/target_name is damaged")));
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// An audit reports exactly the faults that were introduced into a valid data set.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

#include "classify/dataset/directory/audit.h"
#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/directory/export.h"
#include "classify/dataset/format/hdf5_file.h"
#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/shard.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/classify/dataset/data_directory.h"
#include "tests/refusal.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class CompleteDataSet : public DataSetDirectory {
 protected:
  void SetUp() override { make_complete(); }
};

class DataSetAudit : public CompleteDataSet {
 protected:
  // The faults after a change of a shard and its checksum, as a faulty program would make it.
  std::vector<std::string> falsify(std::size_t index, const std::function<void(Shard&)>& change) {
    Shard shard = shard_of(index);
    change(shard);
    const fs::path file = directory_ / shard_name(index);
    fs::remove(file);
    write_shard(file, shard, scenario_.features.max_centres);
    Manifest manifest = read_manifest(directory_ / kManifestFile);
    manifest.shards[index].sha256 = sha256_file(file);
    write_file(directory_ / kManifestFile, to_json(manifest));
    return faults();
  }

  std::vector<std::string> faults() const { return audit(directory_).faults; }
};

TEST_F(DataSetAudit, CountsAValidDataSet) {
  const Audit result = audit(directory_);
  EXPECT_THAT(result.faults, IsEmpty());
  EXPECT_EQ(result.shards, plan_.shards());
  EXPECT_EQ(result.samples, plan_.size());
  EXPECT_EQ(result.groups, 2u);
  EXPECT_THAT(result.per_target, ElementsAre(plan_.size() / 2, plan_.size() / 2));
}

TEST_F(DataSetAudit, ReportsAWrongLabel) {
  EXPECT_THAT(falsify(1, [](Shard& shard) { shard.samples[0].record.label = 1 - shard.samples[0].record.label; }),
              ElementsAre(HasSubstr("sample 3: label")));
}

TEST_F(DataSetAudit, ReportsDuplicateAndMissingSamplesAndThoseOutOfOrder) {
  EXPECT_THAT(falsify(0, [](Shard& shard) { shard.samples[1] = shard.samples[0]; }),
              ElementsAre(HasSubstr("shard_00000.h5: row 1 contains sample 0, by the manifest 1"),
                          HasSubstr("3 of 8 samples are missing")));
  EXPECT_THAT(falsify(0, [](Shard& shard) { std::swap(shard.samples[1], shard.samples[2]); }),
              ElementsAre(HasSubstr("shard_00000.h5: row 1 contains sample 2, by the manifest 1"),
                          HasSubstr("3 of 8 samples are missing")));
}

// A map near the smallest float loses digits when it is stored; its peak and energy are computed before that.
TEST_F(DataSetAudit, AllowsForTheRoundingOfTheSmallestNumbers) {
  const auto with_factor = [&](double stored, double recorded) {
    return falsify(0, [&](Shard& shard) {
      for (Sample& sample : shard.samples) {
        for (float& value : sample.magnitude) value = static_cast<float>(value * stored);
        sample.record.peak_m *= recorded;
        sample.record.energy_m2 *= recorded * recorded;
      }
    });
  };
  EXPECT_THAT(with_factor(1.2e-41, 1.2e-41), IsEmpty());
  EXPECT_THAT(with_factor(1e-30, 1.001e-30), Contains(HasSubstr("peak_m")));
  EXPECT_THAT(with_factor(1e-30, 1.001e-30), Contains(HasSubstr("energy_m2")));
}

TEST_F(DataSetAudit, ReportsEqualMapsOfTwoSamples) {
  falsify(0, [](Shard& shard) {
    shard.samples[1].magnitude = shard.samples[0].magnitude;
    shard.samples[1].record.peak_m = shard.samples[0].record.peak_m;
    shard.samples[1].record.energy_m2 = shard.samples[0].record.energy_m2;
  });
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("the same map as sample 0")));
}

TEST_F(DataSetAudit, ReportsMapsThatDifferFromTheirRows) {
  EXPECT_THAT(falsify(2, [](Shard& shard) { shard.samples[0].magnitude[1] = 2.5F; }),
              ElementsAre(HasSubstr("energy_m2")));
  EXPECT_THAT(falsify(2, [](Shard& shard) { shard.samples[0].magnitude[1] = std::numeric_limits<float>::quiet_NaN(); }),
              ElementsAre(HasSubstr("no magnitude")));
}

TEST_F(DataSetAudit, ReportsNumbersThatAreNotFinite) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  EXPECT_THAT(falsify(1, [](Shard& shard) { shard.samples[0].magnitude[2] = kInfinity; }),
              ElementsAre(HasSubstr("sample 3: inf in the map is no magnitude")));
  EXPECT_THAT(falsify(1, [](Shard& shard) { shard.samples[0].record.mwr = std::numeric_limits<double>::quiet_NaN(); }),
              ElementsAre(HasSubstr("sample 3: mwr nan is not finite")));
  EXPECT_THAT(falsify(1, [](Shard& shard) { shard.samples[0].record.scr_per_pulse_db = kInfinity; }),
              ElementsAre(HasSubstr("sample 3: scr_per_pulse_db inf is not finite")));
  EXPECT_THAT(falsify(1, [](Shard& shard) { shard.samples[0].record.scr_per_pulse_db = std::nan(""); }), IsEmpty());
  falsify(1, [](Shard& shard) {
    shard.samples[0].record.centres = 1;
    shard.samples[0].centre_list = {{1, kInfinity, 2}};
  });
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("sample 3: scattering centre at 1 m, inf m/s, 2 m is not finite")));
}

TEST_F(DataSetAudit, ReportsComplexMapsOfOtherMagnitude) {
  const auto with_complex = [&](float last) {
    for (std::size_t i = 0; i < plan_.shards(); ++i) {
      falsify(i, [&](Shard& shard) {
        for (Sample& sample : shard.samples) {
          for (const float value : sample.magnitude) {
            sample.complex_values.push_back(0.6F * value);
            sample.complex_values.push_back(-0.8F * value);
          }
          if (sample.record.sample == 3) sample.complex_values.back() = last;
        }
      });
    }
    return faults();
  };
  EXPECT_THAT(with_complex(-0.8F * 7), IsEmpty());
  EXPECT_THAT(with_complex(-0.8F * 7.001F), ElementsAre(HasSubstr("sample 3: complex value of magnitude")));
  EXPECT_THAT(with_complex(std::nanf("")), ElementsAre(HasSubstr("sample 3: complex value of magnitude nan")));
}

TEST_F(DataSetAudit, ReportsAManifestOfAnotherSeedNameVersionOrProcessor) {
  const Manifest good = read_manifest(directory_ / kManifestFile);
  const auto with = [&](const std::function<void(Manifest&)>& change) {
    Manifest manifest = good;
    change(manifest);
    write_file(directory_ / kManifestFile, to_json(manifest));
    return faults();
  };
  EXPECT_THAT(with([](Manifest& m) { m.seed = 7; }), ElementsAre("manifest.json: seed 7, the scenario has 42"));
  EXPECT_THAT(with([](Manifest& m) { m.scenario = "other"; }),
              ElementsAre("manifest.json: scenario 'other', its name is 'small'"));
  EXPECT_THAT(with([](Manifest& m) { m.program_version = "0.0.7"; }),
              testing::Each(HasSubstr("made by version 0.0.0, by the manifest 0.0.7")));
  EXPECT_THAT(with([](Manifest& m) { m.program_version = "0.0.7"; }), testing::SizeIs(3));
  EXPECT_THAT(with([](Manifest& m) { m.processors.push_back("z"); }),
              ElementsAre(HasSubstr("manifest.json: processors ")));
  fs::rename(directory_ / shard_name(1), directory_ / "second.h5");
  EXPECT_THAT(with([](Manifest& m) { m.shards[1].file = "second.h5"; }),
              ElementsAre("second.h5: by its number shard_00001.h5"));
}

TEST_F(DataSetAudit, ReportsASeaInTwoGroups) {
  falsify(0, [](Shard& shard) { shard.samples[0].record.group = 1; });
  EXPECT_THAT(faults(),
              ElementsAre(HasSubstr("sample 0: group 1, by the scenario 0"),
                          HasSubstr("group 1: contains 2 sea realisations"), HasSubstr("a split by group would leak")));
}

TEST_F(DataSetAudit, ReportsDamagedTruncatedAndForeignFiles) {
  write_file(directory_ / leftover_name("shard_00007.h5"), "half");
  const TemporaryFile being_written(directory_ / "dataset.h5");
  write_file(directory_ / "notes.tmp", "no file of a data set");
  write_file(directory_ / "other.h5", "foreign");
  damage(directory_ / shard_name(1), fs::file_size(directory_ / shard_name(1)) / 2);
  const std::vector<std::string> found = faults();
  EXPECT_EQ(found.size(), 5u);  // and three samples are missing
  EXPECT_THAT(found, Contains(HasSubstr("half-written")));
  EXPECT_THAT(found, Contains(HasSubstr("other.h5: not in the manifest")));
  EXPECT_THAT(found, Contains("notes.tmp: is no file of a data set"));
  EXPECT_THAT(found, Contains(HasSubstr("truncated or changed")));
  EXPECT_THAT(found, Contains(HasSubstr("3 of 8 samples are missing")));
}

TEST_F(DataSetAudit, ReportsAnotherScenario) {
  std::string yaml = read_file(directory_ / kScenarioFile);
  const std::string seed = "seed: ";
  yaml.insert(yaml.find(seed) + seed.size(), "9");
  write_file(directory_ / kScenarioFile, yaml);
  const std::vector<std::string> found = faults();
  EXPECT_HAS(found.front(), "is not the one that the manifest was written for");
  EXPECT_THAT(found, Contains(HasSubstr("sample 0: seed")));
}

// One virtual file over all shards: it returns the shards' data and is not written over shards that are missing,
// damaged or foreign.

class MergedDataSet : public CompleteDataSet {
 protected:
  std::string refusal() const {
    const std::string message = refusal_of([&] { merge(); });
    EXPECT_FALSE(fs::exists(file()));
    return message;
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
  EXPECT_EQ(merged.rows<std::string>("/samples/target_name", 6, 1)[0], shard_of(2).samples[0].record.target_name);
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
  EXPECT_HAS(refusal(), "shard_00001.h5: missing");
  fs::remove(directory_ / kManifestFile);
  EXPECT_HAS(refusal(), "shard_00001.h5: missing (1 of 3 shards)");
}

TEST_F(MergedDataSet, IsRefusedWhereAShardIsDamaged) {
  const fs::path shard = directory_ / shard_name(1);
  damage(shard, fs::file_size(shard) - 1);
  EXPECT_HAS(refusal(), "shard_00001.h5: truncated or changed");
  fs::resize_file(shard, fs::file_size(shard) - 1);
  fs::remove(directory_ / kManifestFile);
  EXPECT_HAS(refusal(), "shard_00001.h5: damaged or of another scenario");
}

TEST_F(MergedDataSet, IsRefusedWhereAShardIsForeign) {
  const fs::path more = directory_ / "shard_00003.h5";
  fs::copy_file(directory_ / shard_name(0), more);
  EXPECT_HAS(refusal(), "shard_00003.h5: foreign");
  fs::remove(more);
  Shard other = shard_of(1);
  for (Sample& sample : other.samples) sample.record.seed = 43;
  write_shard(directory_ / shard_name(1), other, scenario_.features.max_centres);
  EXPECT_HAS(refusal(), "shard_00001.h5: truncated or changed");
  fs::remove(directory_ / kManifestFile);
  EXPECT_HAS(refusal(), "shard_00001.h5: damaged or of another scenario");
}

TEST_F(MergedDataSet, IsRefusedWhereAShardIsOfAnotherVersion) {
  Shard other = shard_of(1);
  other.origin.program_version = "0.0.1";
  write_shard(directory_ / shard_name(1), other, scenario_.features.max_centres);
  fs::remove(directory_ / kManifestFile);
  EXPECT_HAS(refusal(), "shard_00001.h5: made by seaglint 0.0.1, this is seaglint 0.0.0");
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

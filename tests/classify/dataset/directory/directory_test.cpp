// SPDX-License-Identifier: BSD-3-Clause
// A data set directory when it is created, resumed, damaged and read.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>

#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/directory/dataset_writer.h"
#include "classify/dataset/format/hdf5_file.h"
#include "classify/dataset/format/manifest.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/scenario/scenario.h"
#include "tests/classify/dataset/data_directory.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

TEST_F(DataSetDirectory, IsReadBackCompletely) {
  make_complete();
  const DatasetReader reader(directory_);
  EXPECT_EQ(reader.size(), plan_.size());
  std::int64_t next = 0;
  for (std::size_t i = 0; i < reader.shards(); ++i)
    for (const Sample& sample : reader.shard(i).samples) EXPECT_EQ(sample.record.sample, next++);
  EXPECT_EQ(static_cast<std::size_t>(next), plan_.size());
  EXPECT_EQ(read_scenario(directory_ / kScenarioFile).dataset.maps_per_case, 4);
  EXPECT_HAS(read_file(directory_ / kDataCardFile), "| ship | 1 |");
}

TEST_F(DataSetDirectory, IsIncompleteUntilTheLastShardExists) {
  DatasetWriter writer(directory_, scenario_, false, kTestVersion);
  writer.put(0, shard_of(0));
  EXPECT_THAT(writer.finish(), ElementsAre(1, 2));
  EXPECT_HAS(unreadable(), "no manifest.json");
}

TEST_F(DataSetDirectory, ThatIsNotEmptyNeedsResume) {
  make_complete();
  EXPECT_HAS(refusal_of([&] { DatasetWriter(directory_, scenario_, false, kTestVersion); }), "--resume");
  EXPECT_NO_THROW(DatasetWriter(directory_, scenario_, true, kTestVersion));
}

TEST_F(DataSetDirectory, KeepsItsMapsWhenOnlyLearningChangesAndRefusesAnotherScenario) {
  make_complete();
  scenario_.learning.epochs = 7;
  scenario_.dataset.train_fraction = 0.5;
  EXPECT_TRUE(DatasetWriter(directory_, scenario_, true, kTestVersion).complete(0));
  EXPECT_EQ(read_scenario(directory_ / kScenarioFile).learning.epochs, 7);
  scenario_.seed = 43;
  EXPECT_HAS(not_continued(), "`seed: 42` there, `seed: 43` here");
}

TEST_F(DataSetDirectory, RegeneratesOnlyInvalidShards) {
  make_complete();
  fs::remove(directory_ / kManifestFile);
  fs::resize_file(directory_ / shard_name(1), fs::file_size(directory_ / shard_name(1)) - 10);
  fs::remove(directory_ / shard_name(2));
  DatasetWriter writer(directory_, scenario_, true, kTestVersion);
  EXPECT_TRUE(writer.complete(0));
  EXPECT_FALSE(writer.complete(1));
  EXPECT_FALSE(writer.complete(2));
}

TEST_F(DataSetDirectory, WithAChangedShardIsRefusedWithTheFilesName) {
  make_complete();
  const fs::path file = directory_ / shard_name(1);
  damage(file, read_file(file).size() - 1);
  EXPECT_HAS(refusal_of([&] { DatasetReader(directory_).shard(1); }), "shard_00001.h5: truncated or changed");
  EXPECT_FALSE(DatasetWriter(directory_, scenario_, true, kTestVersion).complete(1));
  fs::remove(file);
  EXPECT_HAS(unreadable(), "shard_00001.h5: missing");
}

// No checksum of HDF5 covers the space between the arrays.
TEST_F(DataSetDirectory, RegeneratesAShardWithChangedPaddingWithoutAManifest) {
  make_complete();
  fs::remove(directory_ / kManifestFile);
  const fs::path file = directory_ / shard_name(1);
  const std::size_t padding = read_file(file).find(std::string(500, '\0'));
  ASSERT_NE(padding, std::string::npos);
  damage(file, padding + 250);
  EXPECT_EQ(read_shard(file).samples.size(), plan_.shard(1).count) << "a byte of the content was changed";
  DatasetWriter writer(directory_, scenario_, true, kTestVersion);
  EXPECT_TRUE(writer.complete(0));
  EXPECT_FALSE(writer.complete(1));
  EXPECT_TRUE(writer.complete(2));
}

// Before there is a manifest, a shard is verified by its content.
TEST_F(DataSetDirectory, IsIncompleteWithADamagedOrForeignShard) {
  DatasetWriter writer(directory_, scenario_, false, kTestVersion);
  for (std::size_t i = 0; i < plan_.shards(); ++i) writer.put(i, shard_of(i));
  fs::resize_file(directory_ / shard_name(0), fs::file_size(directory_ / shard_name(0)) - 10);
  Shard other = shard_of(2);
  for (Sample& sample : other.samples) sample.record.seed = 43;
  other.origin.program_version = kTestVersion;
  fs::remove(directory_ / shard_name(2));
  write_shard(directory_ / shard_name(2), other, scenario_.features.max_centres);
  EXPECT_THAT(DatasetWriter(directory_, scenario_, true, kTestVersion).finish(), ElementsAre(0, 2));
  EXPECT_FALSE(fs::exists(directory_ / kManifestFile));
}

TEST_F(DataSetDirectory, HasNoTemporaryFilesOfKilledRunsOnceComplete) {
  DatasetWriter writer(directory_, scenario_, false, kTestVersion);
  std::vector<std::string> left;
  for (const char* file : {"shard_00001.h5", "manifest.json", "README.md", "scenario.yaml", "all.h5"})
    left.push_back(leftover_name(file));
  const TemporaryFile being_written(directory_ / "dataset.h5");
  std::vector<std::string> others{leftover_name("notes"), "notes.tmp", "shard_00001.h5.tmp",
                                  "shard_00001.h5.node-x.tmp"};
  for (const auto* names : {&left, &others})
    for (const std::string& name : *names) write_file(directory_ / name, "half");
  others.push_back(being_written.path().filename());
  writer.put(0, shard_of(0));
  EXPECT_THAT(writer.finish(), ElementsAre(1, 2));
  for (const std::string& name : left) EXPECT_TRUE(fs::exists(directory_ / name)) << name;
  for (const std::size_t i : {1u, 2u}) writer.put(i, shard_of(i));
  EXPECT_THAT(writer.finish(), testing::IsEmpty());
  for (const std::string& name : left) EXPECT_FALSE(fs::exists(directory_ / name)) << name;
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(directory_ / name)) << name;
}

TEST_F(DataSetDirectory, MayContainOnlyItsTemporaryFilesBeforeItsScenario) {
  fs::create_directories(directory_);
  write_file(directory_ / leftover_name("scenario.yaml"), "half");
  EXPECT_NO_THROW(DatasetWriter(directory_, scenario_, true, kTestVersion));
  fs::remove(directory_ / kScenarioFile);
  write_file(directory_ / "notes.tmp", "mine");
  EXPECT_HAS(not_continued(), "the directory contains notes.tmp, which is no file of a data set");
}

// A scenario alone does not make a directory a data set's, since a run also has one.
TEST_F(DataSetDirectory, IsResumedOnlyIfItContainsNothingElse) {
  make_complete();
  for (const char* name : {"all.h5", "all.npz", ".nfs0001"}) write_file(directory_ / name, "ours, or the system's");
  EXPECT_NO_THROW(DatasetWriter(directory_, scenario_, true, kTestVersion));
  write_file(directory_ / "metrics.json", "{}");
  EXPECT_THAT(not_continued(),
              testing::EndsWith("the directory contains metrics.json, which is no file of a data set"));
  fs::create_directories(directory_ / "data");
  write_file(directory_ / "data" / kScenarioFile, effective_yaml(scenario_));
  EXPECT_THAT(not_continued(), testing::EndsWith("which is no file of a data set; the run's data set is " +
                                                 (directory_ / "data").string()));
}

// No file can be written while this object lives.
class NoSpace {
 public:
  NoSpace() {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit none{0, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &none);
  }
  ~NoSpace() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(DataSetDirectory, AcceptsAShardOfAConcurrentProcess) {
  make_complete();
  DatasetWriter writer(directory_, scenario_, true, kTestVersion);
  const NoSpace none;
  EXPECT_NO_THROW(writer.put(0, shard_of(0)));
  Shard other = shard_of(0);
  other.samples[0].record.mwr = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(writer.put(0, other), WorkError);
  other = shard_of(0);
  other.samples[2].magnitude[0] = 2;
  EXPECT_THROW(writer.put(0, other), WorkError);
}

// Otherwise the manifest would have the checksum of other content.
TEST_F(DataSetDirectory, RefusesAShardOfAConcurrentProcessWithOtherEchoes) {
  scenario_.dataset.echoes = true;
  const auto with_echoes = [&](double last) {
    Shard shard = shard_of(0);
    for (Sample& sample : shard.samples) sample.echo = {1, 2, 3, last};  // two pulses of one frequency
    return shard;
  };
  DatasetWriter writer(directory_, scenario_, false, kTestVersion);
  writer.put(0, with_echoes(4));
  const NoSpace none;
  EXPECT_NO_THROW(writer.put(0, with_echoes(4)));
  EXPECT_THROW(writer.put(0, with_echoes(5)), WorkError);
  EXPECT_THROW(writer.put(0, shard_of(0)), WorkError);
}

TEST_F(DataSetDirectory, RegeneratesShardsWithoutTheArraysThatItsScenarioStores) {
  for (bool DatasetSpec::*array : {&DatasetSpec::echoes, &DatasetSpec::complex_maps}) {
    scenario_.dataset.*array = true;
    DatasetWriter writer(directory_, scenario_, false, kTestVersion);
    writer.put(0, shard_of(0));
    EXPECT_FALSE(DatasetWriter(directory_, scenario_, true, kTestVersion).complete(0));
    scenario_.dataset.*array = false;
    fs::remove_all(directory_);
  }
}

// The manifest has the checksums of what was written, not of what lies there.
TEST_F(DataSetDirectory, IsIncompleteWithAShardThatIsDamagedAfterItWasWritten) {
  DatasetWriter writer(directory_, scenario_, false, kTestVersion);
  for (std::size_t i = 0; i < plan_.shards(); ++i) writer.put(i, shard_of(i));
  damage(directory_ / shard_name(1), fs::file_size(directory_ / shard_name(1)) / 2);
  EXPECT_THAT(writer.finish(), ElementsAre(1));
  EXPECT_FALSE(fs::exists(directory_ / kManifestFile));
}

TEST_F(DataSetDirectory, RegeneratesShardsWithAppendedBytesOrWithoutAFormat) {
  make_complete();
  fs::remove(directory_ / kManifestFile);
  std::ofstream(directory_ / shard_name(0), std::ios::app) << "x";
  fs::remove(directory_ / shard_name(1));
  Hdf5Writer without_format(directory_ / shard_name(1), Hdf5Version::k18);
  without_format.close();
  DatasetWriter writer(directory_, scenario_, true, kTestVersion);
  EXPECT_FALSE(writer.complete(0));
  EXPECT_FALSE(writer.complete(1));
  EXPECT_TRUE(writer.complete(2));
}

// A manifest with wrong checksums of two shards, as after these were regenerated on a processor with other rounding.
class ConcurrentRepair : public DataSetDirectory {
 protected:
  void SetUp() override {
    make_complete();
    Manifest manifest = read_manifest(directory_ / kManifestFile);
    for (const std::size_t i : {0u, 2u}) manifest.shards[i].sha256 = std::string(64, '0');
    write_file(directory_ / kManifestFile, to_json(manifest));
  }

  // The shards from `first` to `last`, as one part generates them.
  void make_part(DatasetWriter& writer, std::size_t first, std::size_t last) const {
    for (std::size_t i = first; i < last; ++i)
      if (!writer.complete(i)) writer.put(i, shard_of(i));
  }

  void expect_complete() const {
    const DatasetReader reader(directory_);
    for (std::size_t i = 0; i < reader.shards(); ++i) EXPECT_EQ(reader.shard(i).samples.size(), plan_.shard(i).count);
  }
};

TEST_F(ConcurrentRepair, IsCompleteAfterOneRoundOfParts) {
  for (const auto& [first, last] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 3}}) {
    DatasetWriter writer(directory_, scenario_, true, kTestVersion);
    make_part(writer, first, last);
    EXPECT_THAT(writer.finish(), testing::IsEmpty());
  }
  expect_complete();
}

TEST_F(ConcurrentRepair, IsCompleteAfterConcurrentParts) {
  DatasetWriter one(directory_, scenario_, true, kTestVersion), two(directory_, scenario_, true, kTestVersion),
      looks_only(directory_, scenario_, true, kTestVersion);
  make_part(one, 0, 1);
  make_part(two, 2, 3);
  for (DatasetWriter* writer : {&one, &two, &looks_only}) {
    EXPECT_THAT(writer->finish(), testing::IsEmpty());
    expect_complete();
  }
}

TEST_F(DataSetDirectory, OfAnotherVersionIsReadButNotContinued) {
  make_complete();
  const auto resume = [&] { DatasetWriter(directory_, scenario_, true, "0.0.1").finish(); };
  EXPECT_HAS(refusal_of(resume), "manifest.json: made by seaglint 0.0.0, this is seaglint 0.0.1");
  fs::remove(directory_ / kManifestFile);
  EXPECT_HAS(refusal_of(resume), "shard_00000.h5: made by seaglint 0.0.0, this is seaglint 0.0.1");
  make_manifest_again();
  EXPECT_EQ(DatasetReader(directory_).shard(0).origin.program_version, kTestVersion);
}

TEST_F(DataSetDirectory, WithAChangedScenarioIsReadForAnAuditOnly) {
  make_complete();
  write_file(directory_ / kScenarioFile, read_file(directory_ / kScenarioFile) + "# mine\n");
  EXPECT_HAS(unreadable(), "scenario.yaml: is not the one that the manifest was written for");
  EXPECT_NO_THROW(DatasetReader(directory_, ScenarioMismatch::kAccept).shard(0));
}

TEST_F(DataSetDirectory, OfAnotherFormatIsRefused) {
  make_complete();
  const auto replace = [&](const fs::path& file, const std::string& from, const std::string& to) {
    std::string bytes = read_file(file);
    bytes.replace(bytes.find(from), from.size(), to);
    write_file(file, bytes);
  };
  replace(directory_ / kManifestFile, "seaglint data set 4", "seaglint data set 9");
  EXPECT_HAS(unreadable(), "manifest.json: format \"seaglint data set 9\"; this program reads \"seaglint data set 4\"");
  fs::remove(directory_ / kManifestFile);
  // A complete file of another format must not be treated as damaged and regenerated.
  Hdf5Writer other(directory_ / shard_name(1), Hdf5Version::k18);
  other.attribute("format", "seaglint shard 9");
  other.close();
  EXPECT_HAS(refusal_of([&] { DatasetWriter(directory_, scenario_, true, kTestVersion).complete(1); }),
             "shard_00001.h5: format \"seaglint shard 9\"; this program reads \"seaglint shard 5\"");
}

// The action that the message recommends succeeds.
TEST_F(DataSetDirectory, WithADamagedManifestIsResumedWithoutIt) {
  make_complete();
  const fs::path file = directory_ / kManifestFile;
  const std::string good = read_file(file);
  write_file(file, good.substr(0, good.size() / 2));
  EXPECT_THAT(not_continued(),
              testing::EndsWith(
                  "; the shards are kept: remove this file and go on by `seaglint generate SCENARIO -o DIR --resume`"));
  fs::remove(file);
  DatasetWriter writer(directory_, scenario_, true, kTestVersion);
  for (std::size_t i = 0; i < plan_.shards(); ++i) EXPECT_TRUE(writer.complete(i));
  EXPECT_THAT(writer.finish(), testing::IsEmpty());
  EXPECT_EQ(read_file(file), good);
}

TEST_F(DataSetDirectory, WithABrokenManifestIsRefused) {
  make_complete();
  const std::string good = read_file(directory_ / kManifestFile);
  Manifest manifest = read_manifest(directory_ / kManifestFile);
  const auto refused = [&](const std::string& text) {
    write_file(directory_ / kManifestFile, text);
    return unreadable();
  };
  EXPECT_HAS(refused(good.substr(0, good.size() / 2)), "manifest.json");
  EXPECT_HAS(refused("[]"), "manifest.json");
  EXPECT_HAS(refused("{\"format\": \"other\"}"), "format");
  EXPECT_HAS(refused("{\"samples\": 9, " + good.substr(1)),
             "manifest.json: the key 'samples' appears twice in an object");
  std::string outside = good;
  outside.replace(outside.find("shard_00000.h5"), 14, "../secret.h5");
  EXPECT_HAS(refused(outside), "is not the name of a file beside it");
  for (const char* number : {"-3", "3.7", "\"3\""}) {
    std::string other = good;
    other.replace(other.find("\"samples\": 3"), 12, fmt::format("\"samples\": {}", number));
    EXPECT_HAS(refused(other), "must be a whole number") << number;
  }
  manifest.shards.back().samples = 100000000000000;
  manifest.samples = manifest.shards.back().first_sample + manifest.shards.back().samples;
  EXPECT_HAS(refused(to_json(manifest)),
             "manifest.json: shards: shard_00002.h5: samples: 100000000000000, must be within 1 and 10000");
  manifest.shards.clear();
  manifest.samples = 0;
  EXPECT_HAS(refused(to_json(manifest)), "manifest.json: samples: 0, must be within 1 and 1000000000");
}

// 30 deg converted to radians and back is 29.999999999999996: a selection by the scenario's own angle would find
// nothing.
TEST(PlannedRecord, HasTheAnglesOfTheScenario) {
  Scenario scenario;
  scenario.targets.resize(2);
  scenario.sea.propagation_deg = {120, -33.3};
  scenario.view = {{30, 80.1, -7}, {2, 0.7}};
  const SamplePlan plan(scenario);
  std::set<std::tuple<double, double, double>> angles;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const SampleRecord record = planned_record(scenario, plan, i);
    angles.insert({record.propagation_deg, record.azimuth_deg, record.elevation_deg});
  }
  std::set<std::tuple<double, double, double>> given;
  for (const double propagation : scenario.sea.propagation_deg) {
    for (const double azimuth : scenario.view.azimuth_deg)
      for (const double elevation : scenario.view.elevation_deg) given.insert({propagation, azimuth, elevation});
  }
  EXPECT_EQ(angles, given);
}

// Data sets of one seed share the random numbers of their seas, and only they do.
TEST(PlannedRecord, NumbersASeaEquallyInAllDataSets) {
  Scenario scenario;
  scenario.targets.resize(2);
  scenario.sea.significant_wave_height_m = {0.5, 1};
  scenario.dataset.maps_per_case = scenario.dataset.realisations_per_case = 3;
  const auto ids = [](const Scenario& of) {
    std::map<std::int64_t, std::int64_t> id_of_group;
    const SamplePlan plan(of);
    for (std::size_t i = 0; i < plan.size(); ++i) {
      const SampleRecord record = planned_record(of, plan, i);
      EXPECT_EQ(id_of_group.emplace(record.group, record.sea_id).first->second, record.sea_id);
      EXPECT_GE(record.sea_id, 0);
      EXPECT_LT(record.sea_id, std::int64_t{1} << 53);
    }
    return id_of_group;
  };
  const auto first = ids(scenario);
  std::set<std::int64_t> all;
  for (const auto& [group, id] : first) all.insert(id);
  EXPECT_EQ(all.size(), 6u);
  Scenario other = scenario;
  other.view.azimuth_deg = {3, 4, 5};
  EXPECT_EQ(ids(other), first);
  other.seed = 43;
  for (const auto& [group, id] : ids(other)) all.insert(id);
  EXPECT_EQ(all.size(), 12u);
}

TEST(PlannedRecord, HasSwellAndDepthOrZeroForDeepWater) {
  Scenario scenario;
  scenario.targets.resize(1);
  const SampleRecord deep = planned_record(scenario, SamplePlan(scenario), 0);
  EXPECT_EQ(deep.depth_m, 0);
  EXPECT_EQ(deep.swell_wave_height_m, 0);
  scenario.sea.depth_m = 20;
  scenario.sea.swell.significant_wave_height_m = 0.5;
  const SampleRecord shallow = planned_record(scenario, SamplePlan(scenario), 0);
  EXPECT_EQ(shallow.depth_m, 20);
  EXPECT_EQ(shallow.swell_wave_height_m, 0.5);
}

// A data set records its scenario and the files that the scenario names.

class InputList : public ::testing::Test {
 protected:
  InputList() {
    fs::create_directory(folder_ / "data");
    write("ship.obj", "ship");
    scenario_.folder = folder_;
    scenario_.targets.resize(1);
    scenario_.targets[0].name = "ship";
    scenario_.targets[0].mesh = "ship.obj";
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::string complaint() const {
    return refusal_of([&] {
      require_same_inputs(folder_ / "data", scenario_);
      write_input_list(folder_ / "data", scenario_);
    });
  }

  TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
  Scenario scenario_;
};

TEST_F(InputList, IsWrittenOnceAndFilesMustMatchIt) {
  EXPECT_EQ(complaint(), "accepted");
  EXPECT_EQ(read_file(folder_ / "data" / kInputsFile), sha256("ship") + "  targets.ship.mesh\n");
  EXPECT_EQ(complaint(), "accepted");
  write("ship.obj", "another");
  EXPECT_HAS(complaint(),
             fmt::format("inputs.sha256: targets.ship.mesh: {} is not the file that the data set was begun with",
                         (folder_ / "ship.obj").string()));
  EXPECT_EQ(read_file(folder_ / "data" / kInputsFile), sha256("ship") + "  targets.ship.mesh\n");
  write("ship.obj", "ship");
  EXPECT_EQ(complaint(), "accepted");
}

TEST_F(InputList, IncludesTheBuffersOfAMesh) {
  constexpr std::size_t kTriangleBytes = 36;
  write("ship.gltf",
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"parts/hull.bin"}]})");
  fs::create_directory(folder_ / "parts");
  write("parts/hull.bin", std::string(kTriangleBytes, '\0'));
  scenario_.targets[0].mesh = "ship.gltf";
  EXPECT_EQ(complaint(), "accepted");
  EXPECT_HAS(read_file(folder_ / "data" / kInputsFile),
             sha256(std::string(kTriangleBytes, '\0')) + "  targets.ship.mesh/parts/hull.bin\n");
  write("parts/hull.bin", std::string(kTriangleBytes, '\1'));
  EXPECT_HAS(complaint(), "inputs.sha256: targets.ship.mesh/parts/hull.bin: ");
}

TEST_F(InputList, IsNotWrittenWhereNoFileIsNamed) {
  scenario_.targets[0].mesh.clear();
  EXPECT_EQ(complaint(), "accepted");
  EXPECT_FALSE(fs::exists(folder_ / "data" / kInputsFile));
}

TEST_F(InputList, ThatIsNoListIsRefused) {
  write("data/inputs.sha256", "nonsense\n");
  EXPECT_HAS(complaint(), "inputs.sha256:1:1: 'nonsense': must be a checksum and a key");
}

}  // namespace
}  // namespace seaglint

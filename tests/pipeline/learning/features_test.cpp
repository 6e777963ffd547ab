// SPDX-License-Identifier: BSD-3-Clause
// Maps and features made again from stored echoes are those of a data set made anew with the same settings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/directory_bytes.h"
#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A mesh in waves, so that echoes come from the solver: 24 maps in 3 shards.
constexpr const char* kScenario = R"yaml(seaglint: 1
name: floats
view: {azimuth_deg: [30, 80]}
sea: {significant_wave_height_m: 1, peak_period_s: 8, components: 64}
targets:
  one: {label: 1, mesh: assets/icosahedral_reflector.glb, motion: {model: float}}
  two: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float}, layout: {area: {count: 2, length_m: 60}}}
clutter: {scr_db: 10}
dataset: {maps_per_case: 6, realisations_per_case: 2, maps_per_interval: 3, maps_per_shard: 8}
)yaml";

class StoredEchoFeatures : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    write_file(folder_->path() / "floats.yaml", kScenario);
    make(data(), {"--set", "dataset.echoes=true"});
  }
  static void TearDownTestSuite() { delete folder_; }

  static fs::path data() { return folder_->path() / "data"; }
  static fs::path place() { return folder_->path() / testing::UnitTest::GetInstance()->current_test_info()->name(); }
  static void make(const fs::path& directory, std::vector<std::string> more) {
    std::vector<std::string> words{"generate", folder_->path() / "floats.yaml", "-o", directory};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = run_program(words);
    ASSERT_EQ(result.code, 0) << result.err;
  }
  static ProgramResult features(const fs::path& directory, std::vector<std::string> more) {
    std::vector<std::string> words{"features", data(), "-o", directory};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }
  static void expect_equal(const fs::path& a, const fs::path& b) {
    const auto in_a = bytes_of(a), in_b = bytes_of(b);
    EXPECT_EQ(in_a.size(), in_b.size());
    for (const auto& [name, bytes] : in_a) EXPECT_TRUE(in_b.contains(name) && in_b.at(name) == bytes) << name;
  }

  static inline TemporaryFolder* folder_ = nullptr;
};

TEST_F(StoredEchoFeatures, OfTheSameSettingsGiveTheSameBytes) {
  const ProgramResult result = features(place(), {"--threads", "2"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("24 maps made from stored echoes in "));
  expect_equal(data(), place());
}

TEST_F(StoredEchoFeatures, OfOtherSettingsGiveTheBytesOfADataSetMadeAnew) {
  const std::vector<std::string> other{"--set", "clutter.scr_db=25",           "--set", "features.max_centres=20",
                                       "--set", "map.velocity_oversampling=2", "--set", "dataset.echoes=true"};
  const ProgramResult result = features(place(), other);
  ASSERT_EQ(result.code, 0) << result.err;
  make(folder_->path() / "anew", other);
  expect_equal(folder_->path() / "anew", place());
}

TEST_F(StoredEchoFeatures, AreMadeWithoutEchoesOfTheirOwnOnRequest) {
  const ProgramResult result = features(place(), {"--set", "dataset.echoes=false"});
  ASSERT_EQ(result.code, 0) << result.err;
  make(folder_->path() / "without", {});
  expect_equal(folder_->path() / "without", place());
  const ProgramResult again = run_program({"features", place(), "-o", folder_->path() / "none"});
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("has no echoes; make it with dataset.echoes: true"));
  EXPECT_FALSE(fs::exists(folder_->path() / "none"));
}

TEST_F(StoredEchoFeatures, RefuseWhatNeedsOtherEchoes) {
  const auto complaint = [](const char* set) {
    const ProgramResult result = features(place(), {"--set", set});
    EXPECT_EQ(result.code, 2) << set;
    EXPECT_FALSE(fs::exists(place())) << set;
    return result.err;
  };
  EXPECT_THAT(complaint("sea.peak_period_s=9"), HasSubstr("only clutter, map, features and learning can be set"));
  EXPECT_THAT(complaint("seed=3"), HasSubstr("`seed: 42` there, `seed: 3` here"));
  EXPECT_THAT(complaint("dataset.maps_per_case=12"), HasSubstr("maps_per_case: 6` there, `  maps_per_case: 12` here"));
  EXPECT_THAT(complaint("map.range_span_m=900"),
              HasSubstr("map.range_span_m: the stored echoes are those of a range "));
  EXPECT_THAT(complaint("map.range_span=900"), HasSubstr("map.range_span"));
}

}  // namespace
}  // namespace seaglint

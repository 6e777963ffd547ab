// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <filesystem>

#include "tests/pipeline/program.h"
#include "tests/refusal.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

namespace fs = std::filesystem;

// Every command on the scenario without targets.

const std::string kSeaScenario = "scenarios/clutter.yaml";

// 8 shards of 2 maps.
Words sea_data_set(const fs::path& directory, const Words& more) {
  return with_settings(with({"generate", kSeaScenario, "-o", directory}, more),
                       {"radar.pulses=64", "dataset.maps_per_shard=2"});
}

class SeaAloneCommands : public testing::Test {
 protected:
  fs::path out(const std::string& name) const { return folder_.path() / name; }
  void expect_refused(const Words& words, const std::string& message) const {
    SCOPED_TRACE(testing::PrintToString(words));
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_HAS(result.err, message);
    EXPECT_EQ(complaints_in(result.err), 1) << result.err;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(SeaAloneCommands, CheckMapEchoAndSeaWorkAndNameIt) {
  const ProgramResult checked = completed({"check", kSeaScenario});
  EXPECT_HAS(checked.out, "\ntargets: {}\n");
  EXPECT_HAS(checked.err, "clutter: the sea alone, 1 sea states x 1 views = 1 cases, 16 maps");
  EXPECT_HAS(checked.err, "moves               the sea alone\n");
  EXPECT_THAT(checked.err, Not(HasSubstr("warning")));
  const ProgramResult map = completed(with_settings({"map", kSeaScenario, "-o", out("map.svg")}, {"radar.pulses=256"}));
  EXPECT_THAT(map.out, Not(HasSubstr("SCR")));
  EXPECT_HAS(read_file(out("map.svg")), "sea alone, azimuth 0 deg, Hs 2.2 m");
  EXPECT_THAT(read_file(out("map.svg")), Not(HasSubstr("whole map:")));
  EXPECT_HAS(completed(with_settings({"echo", kSeaScenario, "-o", out("echo.npz")}, {"radar.pulses=64"})).out,
             "64 pulses of");
  completed({"sea", kSeaScenario, "-o", out("sea.csv")});
  completed({"check", "scenarios/quick.yaml", "--set", "targets={}", "--set", "clutter.level=git", "--set",
             "sea.significant_wave_height_m=1"});
}

TEST_F(SeaAloneCommands, ThoseThatNeedATargetSayForWhat) {
  const std::string place = kSeaScenario + ":27:10: targets: the sea alone: ";
  expect_refused({"motion", kSeaScenario, "-o", out("motion.csv")},
                 "targets: {} is the sea alone: a motion needs a target with a mesh");
  for (const char* product : {"isar", "hrrp"})
    expect_refused({"map", kSeaScenario, "--product", product, "-o", out("map.png")},
                   place + "an image and a range profile need a target");
  expect_refused({"run", kSeaScenario, "-o", out("run")}, place + "learning needs targets of two classes");
  expect_refused({"benchmark", kSeaScenario, "-o", out("benchmark")}, place + "learning needs targets of two classes");
  expect_refused({"check", kSeaScenario, "--set", "clutter.level=scr"}, "scr is a ratio to a target");
  EXPECT_FALSE(fs::exists(out("run")));
}

TEST_F(SeaAloneCommands, ADataSetHasTheSameBytesByThreadsInPartsAndResumed) {
  const ProgramResult made = completed(sea_data_set(out("one"), {"--threads", "1"}));
  EXPECT_THAT(made.out, Not(HasSubstr("train")));
  completed(sea_data_set(out("two"), {"--threads", "2"}));
  for (const char* part : {"2/2", "1/2"}) completed(sea_data_set(out("parts"), {"--part", part, "--resume"}));
  const auto bytes = bytes_of(out("one"));
  EXPECT_THAT(differences(bytes_of(out("two")), bytes), IsEmpty());
  EXPECT_THAT(differences(bytes_of(out("parts")), bytes), IsEmpty());
  fs::remove(out("two") / "shard_00003.h5");
  fs::remove(out("two") / "manifest.json");
  EXPECT_HAS(completed(sea_data_set(out("two"), {"--resume"})).out, "2 maps made");
  EXPECT_THAT(differences(bytes_of(out("two")), bytes), IsEmpty());
}

TEST_F(SeaAloneCommands, ADataSetIsReadByEveryCommandButLearning) {
  completed(with_settings(sea_data_set(out("data"), {}), {"dataset.echoes=true"}));
  EXPECT_HAS(read_file(out("data") / "README.md"), "maps of the sea without a target");
  EXPECT_HAS(read_file(out("data") / "README.md"), "| sea | 0 (sea) | 16 | nothing: the sea alone |");
  EXPECT_HAS(completed({"verify", out("data"), "--regenerate", "2"}).out, "no fault found");
  EXPECT_HAS(completed({"verify", out("data"), "--cross-check", "1"}).out, "1 sample of the sea alone left out");
  EXPECT_HAS(completed({"look", out("data"), "-o", out("look.svg")}).out, "12 of 16 maps");
  EXPECT_THAT(read_file(out("look.svg")), Not(HasSubstr("SCR")));
  completed({"regenerate", out("data"), "--sample", "5"});
  completed({"features", out("data"), "-o", out("same")});
  EXPECT_THAT(differences(bytes_of(out("same")), bytes_of(out("data"))), IsEmpty());
  completed({"merge", out("data")});
  completed({"export", out("data"), "-o", out("data.npz")});
  expect_refused({"train", out("data"), "-o", out("model")},
                 "maps of the sea alone: learning needs targets of two classes");
  EXPECT_FALSE(fs::exists(out("model")));
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// `seaglint verify` on data sets that the program generated.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class DataSetVerification : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = folder_.path() / "data";
    const ProgramResult generated =
        run_program({"generate", "scenarios/points.yaml", "-o", directory_, "--set", "dataset.maps_per_shard=5"});
    ASSERT_EQ(generated.code, 0) << generated.err;
  }

  TemporaryFolder folder_;
  fs::path directory_;
};

TEST_F(DataSetVerification, AcceptsAValidDataSetAndItsRegeneratedSamples) {
  const ProgramResult result = run_program({"verify", directory_, "--regenerate", "4"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("4 regenerated samples match the stored ones"));
  EXPECT_THAT(result.out, HasSubstr("no fault found"));
}

TEST_F(DataSetVerification, CrossChecksNoIdealPoints) {
  const ProgramResult result = run_program({"verify", directory_, "--regenerate", "0", "--cross-check", "3"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("3 samples of ideal points left out, which have no solver"));
  const ProgramResult bounded =
      run_program({"verify", directory_, "--regenerate", "0", "--cross-check", "3", "--cross-check-db", "-20"});
  EXPECT_EQ(bounded.code, 2);
  EXPECT_THAT(bounded.err, HasSubstr("--cross-check-db: none of 3 samples has a solver"));
  EXPECT_THAT(run_program({"verify", directory_, "--cross-check-db", "-20"}).err,
              HasSubstr("--cross-check-db requires --cross-check"));
}

// Two samples of a reflector; -300 dB is below any difference of two methods, 20 dB above that of any that agree.
TEST(CrossCheckedDataSet, ReportsDifferencesAndFailsOnlyAboveTheBound) {
  const TemporaryFolder folder;
  const std::string data = folder.path() / "data";
  write_file(folder.path() / "reflector.yaml",
             "seaglint: 1\nradar: {pulses: 16}\nview: {azimuth_deg: [10, 40], elevation_deg: 2}\ntargets:\n"
             "  reflector: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float}}\n"
             "dataset: {maps_per_case: 1, realisations_per_case: 1}\n");
  ASSERT_EQ(run_program({"generate", folder.path() / "reflector.yaml", "-o", data}).code, 0);
  const auto verify = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"verify", data, "--regenerate", "0", "--cross-check", "9"});
    return run_program(more);
  };
  const ProgramResult reported = verify({});
  EXPECT_EQ(reported.code, 0) << reported.err;
  EXPECT_THAT(reported.out, HasSubstr("  reflector  beams   rays "));
  EXPECT_EQ(verify({"--cross-check-db", "20"}).code, 0);
  const ProgramResult failed = verify({"--cross-check-db", "-300"});
  EXPECT_EQ(failed.code, 1);
  EXPECT_THAT(failed.err, HasSubstr("the median relative difference of the response, "));
  EXPECT_EQ(failed.out, reported.out);
}

TEST_F(DataSetVerification, NeitherMergesOverItselfNorAcceptsItAsARun) {
  const std::string shard = read_file(directory_ / "shard_00000.h5"),
                    scenario = read_file(directory_ / "scenario.yaml");
  for (const char* name : {"shard_00000.h5", "scenario.yaml", "manifest.json", "merged.txt"}) {
    const ProgramResult merged = run_program({"merge", directory_, "-o", directory_ / name});
    EXPECT_EQ(merged.code, 2) << name;
    EXPECT_THAT(merged.err, HasSubstr(name));
  }
  const ProgramResult run =
      run_program({"run", "scenarios/points.yaml", "--set", "seed=99", "-o", directory_, "--resume"});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("contains something else than a run"));
  EXPECT_EQ(read_file(directory_ / "shard_00000.h5"), shard);
  EXPECT_EQ(read_file(directory_ / "scenario.yaml"), scenario);
  EXPECT_EQ(run_program({"verify", directory_, "--regenerate", "0"}).code, 0);
}

TEST_F(DataSetVerification, RefusesATruncatedShard) {
  fs::path shard;
  for (const auto& entry : fs::directory_iterator(directory_)) {
    if (entry.path().extension() == ".h5") shard = entry.path();
  }
  fs::resize_file(shard, fs::file_size(shard) / 2);
  const ProgramResult result = run_program({"verify", directory_});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("faults, the first: " + shard.string()));
}

TEST_F(DataSetVerification, RefusesAForeignFile) {
  write_file(directory_ / "foo", "");
  const ProgramResult result = run_program({"verify", directory_});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.out, HasSubstr("fault: foo: is no file of a data set\n"));
  fs::remove(directory_ / "foo");
  write_file(directory_ / ".nfs0001", "");  // temporary file of a network file server
  EXPECT_EQ(run_program({"verify", directory_, "--regenerate", "0"}).code, 0);
}

TEST_F(DataSetVerification, RefusesAMissingManifest) {
  fs::remove(directory_ / "manifest.json");
  const ProgramResult result = run_program({"verify", directory_});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("manifest.json"));
}

}  // namespace
}  // namespace seaglint

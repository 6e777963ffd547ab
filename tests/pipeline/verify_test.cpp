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

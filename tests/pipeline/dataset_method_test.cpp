// SPDX-License-Identifier: BSD-3-Clause
// The method of a target's solver is part of what a data set is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class DataSetOfRays : public testing::Test {
 protected:
  void SetUp() override {
    const std::string plate = folder_.path() / "plate.glb";
    ASSERT_EQ(run_program({"mesh", "make", "plate", "--length-m", "0.5", "--width-m", "0.3", "-o", plate}).code, 0);
    write_file(scenario_,
               "seaglint: 1\nradar: {pulses: 16}\nview: {azimuth_deg: [0, 10], elevation_deg: 2}\n"
               "targets:\n  plate: {label: 0, mesh: '" +
                   plate +
                   "', solver: {method: rays, ray_spacing_m: 0.02}}\n"
                   "dataset: {maps_per_case: 2, realisations_per_case: 1, maps_per_shard: 2}\n");
    const ProgramResult generated = generate({});
    ASSERT_EQ(generated.code, 0) << generated.err;
  }
  ProgramResult generate(std::vector<std::string> more) const {
    more.insert(more.begin(), {"generate", scenario_, "-o", directory_});
    return run_program(more);
  }
  std::string stored() const { return read_file(directory_ / "scenario.yaml"); }

  // Replaces a line of the stored scenario.
  void change(const std::string& line, const std::string& by) const {
    std::string text = stored();
    const std::size_t place = text.find(line);
    ASSERT_NE(place, std::string::npos) << text;
    write_file(directory_ / "scenario.yaml", text.replace(place, line.size(), by));
  }

  TemporaryFolder folder_;
  fs::path directory_ = folder_.path() / "data", scenario_ = folder_.path() / "plate.yaml";
};

TEST_F(DataSetOfRays, RecordsMethodAndSpacing) {
  EXPECT_THAT(stored(), testing::AllOf(HasSubstr("method: rays"), HasSubstr("ray_spacing_m: 0.02")));
  const ProgramResult verified = run_program({"verify", directory_, "--regenerate", "4"});
  EXPECT_EQ(verified.code, 0) << verified.err << verified.out;
  EXPECT_THAT(verified.out, HasSubstr("4 regenerated samples match the stored ones"));
  EXPECT_EQ(run_program({"regenerate", directory_, "--sample", "3"}).code, 0);
  EXPECT_EQ(run_program({"merge", directory_}).code, 0);
}

TEST_F(DataSetOfRays, IsNotContinuedByAnotherMethodOrSpacing) {
  const std::string before = stored();
  const ProgramResult beams = generate(
      {"--resume", "--set", "targets.plate.solver.method=beams", "--set", "targets.plate.solver.ray_spacing_m=0"});
  EXPECT_EQ(beams.code, 2);
  EXPECT_THAT(beams.err, testing::AllOf(HasSubstr("method: rays` there"), HasSubstr("method: beams` here")));
  const ProgramResult finer = generate({"--resume", "--set", "targets.plate.solver.ray_spacing_m=0.01"});
  EXPECT_EQ(finer.code, 2);
  EXPECT_THAT(finer.err,
              testing::AllOf(HasSubstr("ray_spacing_m: 0.02` there"), HasSubstr("ray_spacing_m: 0.01` here")));
  EXPECT_EQ(stored(), before);
}

// A scenario that states another method than the one that made the maps is found by its checksum.
TEST_F(DataSetOfRays, WithAnotherMethodInItsScenarioIsRefused) {
  change("method: rays", "method: beams");
  change("ray_spacing_m: 0.02", "ray_spacing_m: 0");
  const ProgramResult verified = run_program({"verify", directory_});
  EXPECT_EQ(verified.code, 2);
  EXPECT_THAT(verified.out, HasSubstr("scenario.yaml"));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"regenerate", directory_, "--sample", "0"}, {"merge", directory_}}) {
    const ProgramResult result = run_program(command);
    EXPECT_EQ(result.code, 2) << command[0] << result.out;
    EXPECT_THAT(result.err, HasSubstr("scenario.yaml")) << command[0];
  }
}

}  // namespace
}  // namespace seaglint

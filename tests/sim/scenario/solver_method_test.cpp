// SPDX-License-Identifier: BSD-3-Clause
// The method of a target's solver and the distance between its rays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/scenario/writer.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using testing::HasSubstr;

std::string with_solver(const std::string& keys) {
  return "seaglint: 1\ntargets:\n  a:\n    label: 1\n    mesh: a.glb\n    solver: {" + keys + "}\n";
}

SolverSpec solver_of(const std::string& yaml) { return parse(yaml).targets[0].solver; }

TEST(SolverMethodKeys, AreReadAndWrittenWithTheirDefaults) {
  EXPECT_EQ(solver_of(kShort).method, SolverMethod::kBeams);
  EXPECT_EQ(solver_of(kShort).ray_spacing_m, 0);
  const Scenario scenario = parse(with_solver("method: rays, ray_spacing_m: 0.013"));
  const SolverSpec again = solver_of(effective_yaml(scenario));
  EXPECT_EQ(again.method, SolverMethod::kRays);
  EXPECT_EQ(again.ray_spacing_m, 0.013);
  EXPECT_THAT(effective_yaml(parse(kShort)), HasSubstr("method: beams"));
}

TEST(SolverMethodKeys, AreRefusedOutsideOfTheirBounds) {
  EXPECT_THAT(complaint_about(with_solver("method: sbr")),
              HasSubstr("6:22: targets.a.solver.method: value 'sbr': must be beams or rays"));
  for (const char* spacing : {"9e-6", "1.01", "-0.1"})
    EXPECT_THAT(complaint_about(with_solver(std::string("method: rays, ray_spacing_m: ") + spacing)),
                HasSubstr("targets.a.solver.ray_spacing_m: value '" + std::string(spacing) + "': must be"));
  for (const char* spacing : {"0", "1e-5", "1"})
    EXPECT_EQ(complaint_about(with_solver(std::string("method: rays, ray_spacing_m: ") + spacing)), "none");
}

TEST(SolverMethodKeys, OfBeamsHaveNoDistanceBetweenRays) {
  const std::string rule = "valid only with method: rays; beams have min_patch_m";
  EXPECT_EQ(complaint_about(with_solver("ray_spacing_m: 0.01")),
            "folder/file.yaml:6:29: targets.a.solver.ray_spacing_m: value '0.01': " + rule);
  EXPECT_EQ(complaint_about(with_solver("method: beams, ray_spacing_m: 0")), "none");
  const std::string rays = with_solver("method: rays, ray_spacing_m: 0.01");
  EXPECT_THAT(complaint_about(rays, {{"targets.a.solver.method", "beams"}}), HasSubstr("value '0.01': " + rule));
  EXPECT_THAT(complaint_about(kShort, {{"targets.a.solver.ray_spacing_m", "0.01"}}),
              testing::AllOf(testing::StartsWith("--set targets.a.solver.ray_spacing_m"), HasSubstr(rule)));
}

}  // namespace
}  // namespace seaglint

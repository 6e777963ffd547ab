// SPDX-License-Identifier: BSD-3-Clause
// Targets with role: part have no samples of their own, and are in those of the targets that they accompany.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "classify/dataset/directory/dataset_writer.h"
#include "sim/core/process/error.h"
#include "tools/pipeline/moving_bodies.h"
#include "tools/pipeline/pipeline.h"
#include "tools/report/report_text.h"

namespace seaglint {
namespace {

// A guarded target between two others; the decoy is `decoy_keys`.
Scenario guarded(const std::string& decoy_keys) {
  return parse_scenario(fmt::format(R"(
seaglint: 1
sea: {{significant_wave_height_m: 1, components: 64}}
targets:
  alone: {{label: 0, mesh: assets/icosahedral_reflector.glb, motion: {{model: float}}}}
  decoy: {{{}, mesh: assets/icosahedral_reflector.glb, motion: {{model: float}},
           layout: {{line: {{count: 2, spacing_m: 20, centre_x_m: 4000}}}}}}
  guarded: {{label: 1, points: [{{position_m: [0, 0, 0], amplitude_m: 3}}], companions: [{{target: decoy, x_m: -4000}}]}}
dataset: {{maps_per_case: 4, realisations_per_case: 2}}
)",
                                    decoy_keys),
                        "guarded.yaml");
}

TEST(PartTargets, HaveNoSamplesAndTheOthersAreUnchanged) {
  const Pipeline with_part(guarded("role: part")), all(guarded("label: 0"));
  const SamplePlan &plan = with_part.plan(), &whole = all.plan();
  EXPECT_THAT(plan.classes(), testing::ElementsAre(0, 2));
  EXPECT_EQ(3 * plan.size(), 2 * whole.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const SampleAddress at = plan.address(i);
    EXPECT_NE(at.target, 1);
    EXPECT_EQ(plan.sample(at), i);
  }
  SampleAddress at;
  at.target = 2;
  const PulseTrain train = with_part.pulse_train(0);
  EXPECT_EQ(with_part.response(at, train).response.values, all.response(at, train).response.values);
  EXPECT_THROW(plan.sample({0, 0, 0, 0, 1}), std::logic_error);
}

TEST(PartTargets, HaveNoReachNoMotionAndNoClassOfTheirOwn) {
  const Scenario scenario = guarded("role: part");
  const Pipeline pipeline(scenario);
  // The decoy is not 4 km away, but where it accompanies the target.
  EXPECT_EQ(pipeline.window_m(), scenario.map.range_span_m);
  EXPECT_GT(Pipeline(guarded("label: 0")).window_m(), 2 * 4000);
  EXPECT_TRUE(pipeline.scene(0, 0)->bodies[1].empty());
  EXPECT_EQ(pipeline.scene(0, 0)->bodies[3].size(), 2u);
  const StopFlag stop = false;
  std::vector<std::string> names;
  for (const NamedTrajectory& body :
       simulate_bodies(scenario, {}, 1, 1, stop, [](const TargetSpec&, const Body&) {}).bodies)
    names.push_back(body.body);
  EXPECT_THAT(names, testing::ElementsAre("alone"));
  EXPECT_THAT(class_names(scenario), testing::ElementsAre("alone", "guarded"));
}

TEST(PartTargets, AreNotCountedAmongTheBodiesOfTheRecords) {
  const Scenario scenario = parse_scenario(R"(
seaglint: 1
targets:
  decoy: {role: part, mesh: assets/icosahedral_reflector.glb, layout: {line: {count: 3}}}
  first: {label: 0, mesh: assets/icosahedral_reflector.glb, layout: {line: {count: 2}, bodies: rigid}}
  second: {label: 1, mesh: assets/icosahedral_reflector.glb, companions: [{target: decoy}]}
dataset: {maps_per_case: 1, realisations_per_case: 1}
)",
                                           "numbers.yaml");
  const Pipeline pipeline(scenario);
  for (std::size_t i = 0; i < pipeline.plan().size(); ++i) {
    const SampleRecord record = planned_record(scenario, pipeline.plan(), i);
    const Target& target = pipeline.targets()[static_cast<std::size_t>(record.target)];
    EXPECT_EQ(record.first_motion_key, static_cast<std::int64_t>(target.first_body));
    EXPECT_EQ(target.first_body, record.target == 1 ? 0u : 2u);
  }
}

}  // namespace
}  // namespace seaglint

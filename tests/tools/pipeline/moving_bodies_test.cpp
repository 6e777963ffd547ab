// SPDX-License-Identifier: BSD-3-Clause
// The bodies whose motion is written as a series are those whose echoes are simulated.
#include "tools/pipeline/moving_bodies.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/core/process/error.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

// Two reflectors of different sizes on a line and a large one alone, in two sea states.
Scenario floats() {
  return parse_scenario(R"(
seaglint: 1
sea: {significant_wave_height_m: [0.5, 1], components: 64}
targets:
  array: {label: 1, mesh: assets/icosahedral_reflector.glb, motion: {model: float}, layout: {line: {count: 2, spacing_m: 40}, scales: {highest: 3}}}
  single: {label: 0, mesh: assets/icosahedral_reflector.glb, scale: 2, motion: {model: float}}
dataset: {maps_per_case: 3, realisations_per_case: 3}
)",
                        "floats.yaml");
}

MovingBodies simulate(const Scenario& scenario, const SeaChoice& choice) {
  const StopFlag stop = false;
  return simulate_bodies(scenario, choice, 5, 1, stop, [](const TargetSpec&, const Body&) {});
}

TEST(MovingBodies, MoveAsTheSamplesOfTheirRealisationDo) {
  const Pipeline pipeline(floats());
  for (const SeaChoice choice : {SeaChoice{0, 0}, SeaChoice{1, 2}}) {
    const MovingBodies moving = simulate(pipeline.scenario(), choice);
    const auto scene = pipeline.scene(static_cast<int>(choice.sea_state), static_cast<int>(choice.realisation));
    std::vector<Trajectory> sampled = scene->bodies[0];
    sampled.insert(sampled.end(), scene->bodies[1].begin(), scene->bodies[1].end());
    ASSERT_EQ(moving.bodies.size(), sampled.size());
    for (std::size_t b = 0; b < sampled.size(); ++b) {
      const double end_s = std::min(5.0, sampled[b].end_s());
      for (const double t : {0.0, end_s / 2, end_s}) {
        EXPECT_EQ(motion_at(moving.bodies[b], t).angles, sampled[b].sample(t).angles) << moving.bodies[b].body << t;
        EXPECT_EQ(motion_at(moving.bodies[b], t).translation, sampled[b].sample(t).translation);
      }
    }
    EXPECT_EQ(moving.sea.field.surface(3, 4, 5).elevation, scene->sea.surface(3, 4, 5).elevation);
  }
}

TEST(MovingBodies, UnderWaterAreRefusedAsTheirEchoesAre) {
  Scenario scenario = floats();
  scenario.targets[1].offset_m = {0, 0, -3};
  try {
    simulate(scenario, {0, 0});
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("else the whole target is under water"));
  }
}

TEST(MovingBodies, AreNamedByTargetAndNumber) {
  std::vector<std::string> names;
  for (const NamedTrajectory& body : simulate(floats(), {}).bodies) names.push_back(body.body);
  EXPECT_THAT(names, testing::ElementsAre("array_1", "array_2", "single"));
}

TEST(MovingBodies, NeedASeaOfTheScenario) {
  EXPECT_THAT(
      [] {
        choose_sea(floats(), {2, 0});
      },
      testing::ThrowsMessage<InputError>("sea_state 2: must be within 0 and 1, the scenario's last"));
  EXPECT_THAT(
      [] {
        choose_sea(floats(), {0, 1000000});
      },
      testing::ThrowsMessage<InputError>("realisation 1000000: must be within 0 and 999999"));
}

}  // namespace
}  // namespace seaglint

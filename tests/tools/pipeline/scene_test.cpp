// SPDX-License-Identifier: BSD-3-Clause
// The bodies of a scenario: each is loaded once for its size, and what does not depend on the size once for all; their
// motion is that of the samples' echoes; degrees of freedom at rest have a reason; parts accompany others only.
#include "tools/pipeline/scene.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>

#include "classify/dataset/directory/dataset_writer.h"
#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scenario/layout/layout.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tests/tools/pipeline/target_responses.h"
#include "tools/pipeline/warnings.h"
#include "tools/report/report.h"

namespace seaglint {
namespace {

using testing::ContainsRegex;
using testing::StartsWith;

class BodyModels : public testing::Test {
 protected:
  BodyModels() { write_mesh(folder_.path() / "sphere.stl", make_sphere(1, 1)); }

  // Target t of a sphere of radius 1 m about its origin.
  Scenario scenario_of(const std::string& target, const std::string& more = "") const {
    return parse_scenario(
        fmt::format("seaglint: 1\ntargets:\n  t: {{label: 1, mesh: sphere.stl, {}}}\n{}\n", target, more),
        (folder_.path() / "file.yaml").string());
  }
  std::vector<std::shared_ptr<const BodyModel>> models(const Scenario& scenario, std::size_t target = 0) {
    const SamplePlan plan(scenario);
    return load_targets({.scenario = scenario, .plan = plan, .cache = &cache_})[target].models;
  }
  std::string complaint(const Scenario& scenario) {
    return refusal_of([&] { models(scenario); });
  }

  TemporaryFolder folder_;
  TargetCache cache_;
};

TEST_F(BodyModels, HaveTheFactorOfTheTargetTimesThatOfTheBody) {
  const Scenario scenario = scenario_of(
      "scale: 3, layout: {line: {count: 20}, scales: {lowest: 0.5, highest: 2}, heights: "
      "{lowest_m: 10, highest_m: 10}}, motion: {model: float}");
  const std::vector<double> factors = body_scales(scenario.targets[0].layout, 1);
  std::set<const PreparedTarget*> prepared;
  const auto bodies = models(scenario);
  ASSERT_EQ(bodies.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(bodies[i]->scale, 3 * factors[i]);
    EXPECT_NEAR(bodies[i]->radius_m, 3 * factors[i], 1e-6 * factors[i]);  // digits of STL
    EXPECT_NEAR(bodies[i]->prepared->scatterer->radius(), 3 * factors[i], 1e-5 * factors[i]);
    prepared.insert(bodies[i]->prepared.get());
  }
  EXPECT_EQ(prepared.size(), 20u);
}

// Froude: of floats alike, periods grow with the square root of the size.
TEST_F(BodyModels, OfFloatsHavePeriodsThatGrowWithTheRootOfTheirSize) {
  const auto particulars = [&](double scale) {
    return std::get<FloatParticulars>(
        models(scenario_of(fmt::format("scale: {}, motion: {{model: float}}", scale))).front()->motion->model);
  };
  const FloatParticulars small = particulars(1), large = particulars(4);
  EXPECT_NEAR(large.diameter / small.diameter, 4, 1e-12);
  EXPECT_NEAR(small.heave.omega0 / large.heave.omega0, 2, 1e-12);
  EXPECT_NEAR(small.roll.omega0 / large.roll.omega0, 2, 1e-12);
  EXPECT_EQ(small.heave.damping, large.heave.damping);
}

TEST_F(BodyModels, OfOneSizeAreOne) {
  const auto bodies = models(scenario_of("layout: {line: {count: 3}}"));
  EXPECT_EQ(bodies[0], bodies[1]);
  EXPECT_EQ(bodies[0], bodies[2]);
  const auto equal = models(scenario_of("scale: 2, layout: {line: {count: 2}, scales: {lowest: 0.5, highest: 0.5}}"));
  EXPECT_EQ(equal[0], equal[1]);
  EXPECT_EQ(equal[0]->prepared, bodies[0]->prepared);
}

// Two targets of one mesh, and seas whose draws leave the mesh as it is.
TEST_F(BodyModels, ShareWhatTheirFieldsDetermine) {
  const Scenario scenario = scenario_of("motion: {model: float, origin_above_waterline_m: 2}",
                                        "  u: {label: 0, mesh: sphere.stl, layout: {line: {count: 2}, bodies: rigid, "
                                        "scales: {highest: 2}}, motion: {model: float, diameter_m: 1}}\n"
                                        "  v: {label: 0, mesh: sphere.stl, solver: {edges: false}}");
  const auto t = models(scenario), u = models(scenario, 1), v = models(scenario, 2);
  EXPECT_EQ(models(scenario_of("layout: {line: {count: 9}, heights: {lowest_m: 1, highest_m: 1}}, motion: {model: "
                               "fixed}"))
                .front()
                ->prepared,
            t.front()->prepared);
  EXPECT_NE(v.front()->prepared, t.front()->prepared);
  EXPECT_NE(v.front()->motion, t.front()->motion);
  // Reflectors of different sizes on one raft.
  EXPECT_EQ(u[0]->motion, u[1]->motion);
  EXPECT_NE(u[0]->prepared, u[1]->prepared);
}

TEST_F(BodyModels, OfManySizesStayWhileTheyAreUsed) {
  const Scenario many = scenario_of("layout: {line: {count: 60}, scales: {highest: 2}}");
  const auto used = models(many);
  models(scenario_of("layout: {line: {count: 60}, scales: {highest: 2}, seed: 5}"));  // nothing refers to these
  const auto again = models(many);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(again[i]->prepared, used[i]->prepared);
}

TEST_F(BodyModels, ReachTheWaterAsTheirSizeSays) {
  const std::string sea = "sea_reflection: {enabled: true}\nview: {elevation_deg: 1}";
  EXPECT_EQ(complaint(scenario_of("layout: {line: {}, heights: {lowest_m: 1.5, highest_m: 1.5}}", sea)), "accepted");
  EXPECT_HAS(complaint(scenario_of("scale: 2, layout: {line: {}, heights: {lowest_m: 1.5, highest_m: 1.5}}", sea)),
             "file.yaml:3:73: targets.t.layout.heights: its lowest body reaches 0.5 m below the water");
  EXPECT_HAS(complaint(scenario_of("layout: {line: {count: 2}, scales: {lowest: 3, highest: 3}, heights: {lowest_m: "
                                   "1.5, highest_m: 1.5}}",
                                   sea)),
             "its lowest body reaches 1.5 m below the water");
  EXPECT_HAS(complaint(scenario_of("scale: 0.25, motion: {model: float, origin_above_waterline_m: -0.5}", sea)),
             "must be greater than -0.25, else the whole target is under water");
}

TEST_F(BodyModels, OfManySizesHaveFewTriangles) {
  write_mesh(folder_.path() / "fine.stl", make_sphere(1, 4));
  EXPECT_HAS(complaint(parse_scenario("seaglint: 1\ntargets:\n  t: {label: 1, mesh: fine.stl, layout: {line: {count: "
                                      "1000}, scales: {highest: 2}, heights: {lowest_m: 10, highest_m: 10}}}\n",
                                      (folder_.path() / "file.yaml").string())),
             "file.yaml:3:71: targets.t.layout.scales: 1000 different bodies with 5120 triangles "
             "each: must have at most 2000000 triangles in all");
}

// Of two layouts with the same bounds, one has a body at 0.9 m, less than the radius.
TEST_F(BodyModels, AreCheckedAtTheHeightsOfEveryLayout) {
  const std::string sea = "sea_reflection: {enabled: true}\nview: {elevation_deg: 1}";
  int refused = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    const Scenario scenario = scenario_of(
        fmt::format("layout: {{line: {{count: 2}}, heights: {{lowest_m: 0.8, highest_m: 1.6}}, seed: {}}}", seed), sea);
    const bool under = std::ranges::min(body_heights_m(scenario.targets[0].layout)) < 1;
    EXPECT_EQ(complaint(scenario) != "accepted", under) << seed;
    refused += under;
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, 20);
}

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

TEST(MovingBodies, MoveAsTheSamplesOfTheirRealisationDo) {
  const Pipeline pipeline(floats());
  for (const SeaChoice choice : {SeaChoice{0, 0}, SeaChoice{1, 2}}) {
    const MovingBodies moving = moving_bodies(pipeline.scenario(), choice, 5);
    const auto scene = pipeline.scene(
        {.sea_state = static_cast<int>(choice.sea_state), .realisation = static_cast<int>(choice.realisation)});
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
    EXPECT_EQ(moving.scene.sea.surface(3, 4, 5).elevation, scene->sea.surface(3, 4, 5).elevation);
  }
}

TEST(MovingBodies, UnderWaterAreRefusedAsTheirEchoesAre) {
  Scenario scenario = floats();
  scenario.targets[1].offset_m = {0, 0, -3};
  EXPECT_HAS(refusal_of([&] { moving_bodies(scenario, {}, 5); }), "else the whole target is under water");
}

TEST(MovingBodies, AreNamedByTargetAndNumber) {
  std::vector<std::string> names;
  for (const NamedTrajectory& body : moving_bodies(floats(), {}, 5).bodies) names.push_back(body.body);
  EXPECT_THAT(names, testing::ElementsAre("array_1", "array_2", "single"));
}

// In the frame of a ship at 4 m/s a free float moves astern, one adrift moves with its wind and current besides, and a
// towed one stays.
TEST(MovingBodies, DriftAndAreTowedInTheFrameOfTheirHost) {
  const std::string corner = "mesh: assets/icosahedral_reflector.glb";
  const Scenario scenario = parse_scenario(
      fmt::format(
          "seaglint: 1\nsea: {{components: 64}}\ntargets:\n"
          "  ship: {{label: 1, {0}, motion: {{model: ship, speed_mps: 4, length_m: 140, beam_m: 19, draught_m: 6}}, "
          "companions: [{{target: free, x_m: -60}}, {{target: adrift, x_m: -80}}, {{target: free, x_m: -60, "
          "towed: true}}]}}\n"
          "  free: {{label: 0, {0}, motion: {{model: float, spin_up_s: 20}}}}\n"
          "  adrift: {{label: 0, {0}, motion: {{model: float, drift: {{wind_mps: 10, current_mps: 0.5, "
          "current_towards_deg: 90, spread_mps: 0.1}}}}, layout: {{line: {{count: 2}}}}}}\n"
          "dataset: {{maps_per_case: 2, realisations_per_case: 2}}\n",
          corner),
      "file.yaml");
  const Pipeline pipeline(scenario);
  const auto scene = pipeline.scene({}), other = pipeline.scene({.realisation = 1});
  const auto& velocities = scene->velocities_mps;
  ASSERT_EQ(velocities.size(), 6u);
  EXPECT_EQ(velocities[0], std::vector<Vec3>{Vec3::Zero()});
  EXPECT_EQ(velocities[3], std::vector<Vec3>{Vec3(-4, 0, 0)});
  EXPECT_EQ(velocities[5], std::vector<Vec3>{Vec3::Zero()});
  ASSERT_EQ(velocities[4].size(), 2u);
  for (const auto& [of, from] : {std::pair{2, Vec3(0, 0, 0)}, {4, Vec3(-4, 0, 0)}}) {
    const auto target = static_cast<std::size_t>(of);
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 own = velocities[target][i] - from - Vec3(0.3, 0.5, 0);
      EXPECT_GT(own.norm(), 1e-4);
      EXPECT_LT(own.norm(), 0.6);
      EXPECT_NE(own, other->velocities_mps[target][i] - from - Vec3(0.3, 0.5, 0));
    }
  }
  // It meets other waves than a free one at its place.
  EXPECT_NE(scene->bodies[5][0].sample(0.05).angles, scene->bodies[3][0].sample(0.05).angles);
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

// A hull and a float with these keys of `motion`, in waves of 0.5 and 1 m.
Scenario bodies(const std::string& ship, const std::string& buoy, const std::string& sea = "") {
  return parse_scenario(fmt::format(R"(
seaglint: 1
sea: {{significant_wave_height_m: [0.5, 1], components: 64{}}}
targets:
  ship: {{label: 1, mesh: assets/combatant_144m.glb, motion: {{{}}}}}
  buoy: {{label: 0, mesh: assets/icosahedral_reflector.glb, motion: {{{}}}}}
dataset: {{maps_per_case: 2, realisations_per_case: 2}}
)",
                                    sea, ship, buoy),
                        "bodies.yaml");
}

TEST(MotionSummary, NamesWhatIsZeroAndTheKeyThatMovesIt) {
  const Pipeline pipeline(bodies("model: ship", "model: float"));
  const std::vector<TargetMotion> all = target_motions(pipeline, trial_seas(pipeline));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(rest_text(all[0]), "surge, sway, heave are 0 without targets.ship.motion.translations: true");
  EXPECT_EQ(rest_text(all[1]),
            "yaw is 0 without targets.buoy.motion.yaw_rate_std_deg_s; surge, sway, heave are 0 without "
            "targets.buoy.motion.translations: true");
  EXPECT_THAT(motion_text(all[0]), ContainsRegex("^roll [0-9.]+, pitch [0-9.]+, yaw [0-9.]+ deg rms$"));
  EXPECT_THAT(motion_text(all[1]), ContainsRegex("^roll [0-9.]+, pitch [0-9.]+ deg rms$"));
}

TEST(MotionSummary, IsSilentWhereAllDegreesOfFreedomMove) {
  const Pipeline pipeline(
      bodies("model: ship, translations: true", "model: float, translations: true, yaw_rate_std_deg_s: 2"));
  for (const TargetMotion& motion : target_motions(pipeline, trial_seas(pipeline))) {
    EXPECT_EQ(rest_text(motion), "");
    EXPECT_THAT(motion_text(motion),
                ContainsRegex("yaw [0-9.]+ deg rms; surge [0-9.]+, sway [0-9.]+, heave [0-9.]+ m"));
  }
}

// A long-crested head sea excites neither roll nor yaw nor sway of a hull that is symmetric.
TEST(MotionSummary, NamesTheSeaWhereItsDirectionLeavesADegreeOfFreedomAtRest) {
  const Pipeline pipeline(bodies("model: ship, translations: true", "model: fixed", ", propagation_deg: 180"));
  const std::vector<TargetMotion> all = target_motions(pipeline, trial_seas(pipeline));
  EXPECT_THAT(rest_text(all[0]), StartsWith("roll, yaw, sway are 0 in these waves (sea.significant_wave_height_m, sea."
                                            "propagation_deg, sea.spreading)"));
  EXPECT_EQ(rest_text(all[1]), "does not move: targets.buoy.motion.model is fixed");
  EXPECT_EQ(motion_text(all[1]), "");
}

// The middle of the drawn directions is a head sea, which hardly any of the set's seas is.
TEST(MotionSummary, OfDrawnSeasIsThatOfTheDataSetsSeas) {
  const Pipeline pipeline(bodies("model: ship", "model: fixed", ", propagation_deg: \"uniform(0, 360)\""));
  const std::vector<TrialSea> seas = trial_seas(pipeline);
  ASSERT_EQ(seas.size(), 4u);
  EXPECT_NE(seas[0].state.propagation_rad, seas[1].state.propagation_rad);
  EXPECT_EQ(rest_text(target_motions(pipeline, seas)[0]),
            "surge, sway, heave are 0 without targets.ship.motion.translations: true");
}

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
  EXPECT_TRUE(pipeline.scene({})->bodies[1].empty());
  EXPECT_EQ(pipeline.scene({})->bodies[3].size(), 2u);
  std::vector<std::string> names;
  for (const NamedTrajectory& body : moving_bodies(scenario, {}, 1).bodies) names.push_back(body.body);
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

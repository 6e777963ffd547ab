// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scenario/layout/layout.h"
#include "sim/scenario/scenario.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tests/tools/pipeline/target_responses.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/scenario_check.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// A swept or drawn key that changes nothing is named, and no other.

// Two reflectors, a and b, with these keys of their own and further sections.
Scenario reflectors(const std::string& keys_a, const std::string& keys_b, const std::string& sections) {
  return parse_scenario(fmt::format(R"(
seaglint: 1
radar: {{pulses: 32, hop_count: 4}}
targets:
  a: {{label: 0, mesh: assets/icosahedral_reflector.glb{}}}
  b: {{label: 1, mesh: assets/icosahedral_reflector.glb, layout: {{line: {{count: 2, spacing_m: 20}}}}{}}}
dataset: {{maps_per_case: 2, realisations_per_case: 2}}
{}
)",
                                    keys_a, keys_b, sections),
                        "reflectors.yaml");
}

std::vector<std::string> warnings(const Scenario& scenario) { return constant_key_warnings(Pipeline(scenario)); }

constexpr const char* kFloat = ", motion: {model: float}";

TEST(ConstantKeys, TheSeaOfMeshesWithoutMotionChangesNothing) {
  const Scenario scenario = reflectors("", "", "sea: {significant_wave_height_m: [0.1, 3]}");
  EXPECT_THAT(
      warnings(scenario),
      ElementsAre("sea.significant_wave_height_m (0.1, 3) changes nothing: maps that differ in it alone are equal: "
                  "targets.a does not move (targets.a.motion); targets.b does not move (targets.b.motion); clutter of "
                  "a given ratio and Doppler has no sea (clutter.level, clutter.doppler)"));
}

TEST(ConstantKeys, TheSeaOfMovingMeshesIsNotNamed) {
  EXPECT_THAT(warnings(reflectors(kFloat, kFloat,
                                  "sea: {significant_wave_height_m: uniform(0.1 3), peak_period_s: [8, 9], "
                                  "propagation_deg: uniform(0 360)}\nview: {azimuth_deg: [10, 50]}")),
              IsEmpty());
}

TEST(ConstantKeys, ATargetThatAloneDoesNotFollowTheSeaIsNamed) {
  EXPECT_THAT(warnings(reflectors("", kFloat, "sea: {significant_wave_height_m: uniform(0.1 3)}")),
              ElementsAre("sea.significant_wave_height_m (uniform(0.1, 3), once per sea) does not change the echo of "
                          "targets.a: targets.a does not move (targets.a.motion)"));
}

TEST(ConstantKeys, ASeaThatMovesTheClutterAloneIsNamedAsThat) {
  for (const std::string clutter : {"level: nrl", "level: tsc", "doppler: sea_state", "doppler: wave_resolved"}) {
    EXPECT_THAT(warnings(reflectors("", "",
                                    fmt::format("sea: {{significant_wave_height_m: [1, 2]}}\nclutter: {{{}}}\n"
                                                "view: {{elevation_deg: 2}}",
                                                clutter))),
                ElementsAre("sea.significant_wave_height_m (1, 2) changes clutter and noise alone, the echo of no "
                            "target: targets.a does not move (targets.a.motion); targets.b does not move "
                            "(targets.b.motion)"))
        << clutter;
  }
}

TEST(ConstantKeys, OfClutterAreNamedWhereTheLevelDoesNotUseThem) {
  EXPECT_THAT(warnings(reflectors("", "", "clutter: {scr_db: uniform(0 20), cnr_db: uniform(10 40)}")), IsEmpty());
  EXPECT_THAT(
      warnings(reflectors("", "", "clutter: {noise_level: snr, scr_db: uniform(0 20), cnr_db: uniform(10 40)}")),
      ElementsAre("clutter.cnr_db (uniform(10, 40), once per map) changes nothing: maps that differ in it alone "
                  "are equal"));
  EXPECT_THAT(warnings(reflectors("", "", "clutter: {enabled: false, scr_db: uniform(0 20)}")).size(), 1u);
}

// The middle value of the height is 0, where no other key of the sea acts; motion is drawn, and first in the list of
// its models is that at rest.
TEST(ConstantKeys, ThatActOnlyWithOtherValuesOfOtherKeysAreNotNamed) {
  EXPECT_THAT(
      warnings(reflectors(kFloat, kFloat, "sea: {significant_wave_height_m: [1, 0, 2], peak_period_s: [7, 9]}")),
      IsEmpty());
  const std::string drawn = ", motion: {model: 'choice(fixed, float)'}";
  EXPECT_THAT(warnings(reflectors(drawn, drawn, "sea: {significant_wave_height_m: [1, 2]}")), IsEmpty());
}

TEST(ConstantKeys, OfASwellWithoutHeightChangeNothing) {
  const std::vector<std::string> lines =
      warnings(reflectors(kFloat, kFloat, "sea: {swell: {peak_period_s: uniform(10 14)}}"));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_HAS(lines[0], "sea.swell.peak_period_s (uniform(10, 14), once per sea) changes nothing");
  EXPECT_THAT(warnings(reflectors(kFloat, kFloat,
                                  "sea: {swell: {significant_wave_height_m: uniform(0.5 1), peak_period_s: "
                                  "uniform(10 14), components: integers(10 60)}}")),
              IsEmpty());
}

// A line has no random places: its seed does nothing, until bodies have headings.
TEST(ConstantKeys, OfALayoutAreComparedInTheMapsOfTheirTarget) {
  const std::string line = ", layout: {line: {count: 2, spacing_m: uniform(5 20)}, seed: integers(0 1000)";
  EXPECT_THAT(warnings(reflectors(line + "}", "", "")),
              ElementsAre("targets.a.layout.seed (integers(0, 1000), once per sea) changes nothing: maps that differ "
                          "in it alone are equal"));
  EXPECT_THAT(warnings(reflectors(line + ", headings: {lowest_deg: 0, highest_deg: 300}}", "", "")), IsEmpty());
  EXPECT_THAT(warnings(reflectors(line + ", scales: {lowest: 0.5, highest: 2}}", "", "")), IsEmpty());
}

TEST(ConstantKeys, WithTheDrawsOfAnotherKeyAreTestedByThemselves) {
  const std::vector<std::string> lines = warnings(parse_scenario(R"(
seaglint: 1
radar: {pulses: 32}
targets:
  a: {label: 0, mesh: assets/icosahedral_reflector.glb, layout: {line: {count: 2, spacing_m: 9}, seed: integers(0 1000),
      headings: {lowest_deg: 0, highest_deg: 300}}}
  b: {label: 1, mesh: assets/icosahedral_reflector.glb, layout: {line: {count: 2, spacing_m: 9}, seed: same(targets.a.layout.seed)}}
)",
                                                                 "twins.yaml"));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_HAS(lines[0], "targets.b.layout.seed (same(targets.a.layout.seed), once per sea) changes nothing");
}

// Edges and many bounces are not in the cheap maps, but in those that decide.
TEST(ConstantKeys, OfTheSolverAndOfSheetsAreNotNamedForCheapMaps) {
  const TemporaryFolder folder;
  write_mesh(folder.path() / "plate.obj", make_plate(0.5, 0.5));
  const auto plate = [&](const std::string& keys) {
    write_file(folder.path() / "plate.yaml",
               fmt::format("seaglint: 1\nradar: {{pulses: 32, hop_count: 4}}\nview: {{elevation_deg: 60}}\n"
                           "targets:\n  a: {{label: 0, mesh: plate.obj{}}}\n  b: {{label: 1, points: [{{position_m: "
                           "[1, 0, 0]}}]}}\n",
                           keys));
    return warnings(read_scenario(folder.path() / "plate.yaml"));
  };
  EXPECT_THAT(plate(", sheet_thickness_mm: uniform(0 20)"), IsEmpty());
  EXPECT_THAT(plate(", solver: {edges: 'choice(true, false)'}"), IsEmpty());
  EXPECT_THAT(plate(", unit: 'choice(m, cm)', material: 'choice(pec, aluminium)'").size(), 0u);
  EXPECT_THAT(plate(", motion: {roll_period_s: uniform(5 10)}").size(), 1u);  // of a fixed plate
  EXPECT_THAT(warnings(reflectors(", solver: {max_bounces: integers(1 4)}", "", "")), IsEmpty());
}

TEST(ConstantKeys, OfTheRadarAreComparedInMaps) {
  const std::string keys =
      "hop_code: 'choice(random, stepped)', pri_jitter_us: uniform(0 20), polarisation: 'choice(vv, hv)'";
  const auto points = [&](const std::string& radar) {
    return warnings(parse_scenario(fmt::format("seaglint: 1\nradar: {{pulses: 32, {}}}\ntargets:\n"
                                               "  a: {{label: 0, points: [{{position_m: [3, 0, 0]}}]}}\n"
                                               "  b: {{label: 1, points: [{{position_m: [9, 0, 0]}}]}}\n",
                                               radar),
                                   "points.yaml"));
  };
  // An ideal point returns any polarisation alike.
  EXPECT_THAT(points(keys), ElementsAre("radar.polarisation (choice(vv, hv), once per observation) changes nothing: "
                                        "maps that differ in it alone are equal"));
  EXPECT_THAT(points("platform: {velocity_mps: [50, 50, 0]}, hop_code: 'choice(random, balanced, stepped)'"),
              IsEmpty());
}

TEST(ConstantKeys, OfTheViewAreNamedForAPointThatIsSeenAlikeFromAllSides) {
  const std::vector<std::string> lines = warnings(parse_scenario(
      "seaglint: 1\nradar: {pulses: 32}\nview: {azimuth_deg: 0:350:10, elevation_deg: uniform(1 5)}\ntargets:\n"
      "  mast: {label: 0, points: [{position_m: [0, 0, 9]}]}\n  two: {label: 1, points: [{position_m: [9, 0, 0]}]}\n",
      "mast.yaml"));
  EXPECT_THAT(lines, ElementsAre("view.azimuth_deg (0 to 350 in 36 values) does not change the echo of targets.mast"));
}

TEST(ConstantKeys, OfAReflectionThatIsOffChangeNothing) {
  const std::string keys = "sea_reflection: {temperature_c: uniform(0 25), enabled: ";
  EXPECT_THAT(warnings(reflectors("", "", keys + "false}")),
              ElementsAre("sea_reflection.temperature_c (uniform(0, 25), once per sea) changes nothing: maps that "
                          "differ in it alone are equal: sea_reflection.enabled is false"));
  EXPECT_THAT(warnings(reflectors(", motion: {model: float}", ", motion: {model: float}", keys + "true}")), IsEmpty());
  // The roughness of the reflecting sea follows its height, although nothing moves.
  const std::string raised = ", motion: {model: float, spin_up_s: 0, translations: false}";
  EXPECT_THAT(warnings(reflectors(raised, raised,
                                  "sea: {significant_wave_height_m: [0.5, 1]}\nsea_reflection: {enabled: true}")),
              IsEmpty());
}

TEST(ConstantKeys, AreFoundAsTheMapsOfTheDataSetAre) {
  const Scenario read = reflectors("", kFloat, "sea: {significant_wave_height_m: [0.1, 3]}");
  const Pipeline pipeline(
      parse_scenario(effective_yaml(read), "same.yaml", {{"clutter.enabled", "false"}, {"radar.hop_code", "stepped"}}));
  const std::vector<KeyEffect> effects = key_effects(pipeline);
  ASSERT_EQ(effects.size(), 1u);
  EXPECT_THAT(effects[0].same_targets, ElementsAre(0));
  for (const int target : {0, 1}) {
    std::vector<std::vector<float>> maps;
    for (const int state : {0, 1})
      maps.push_back(
          pipeline.generate_sample(pipeline.plan().sample({.sea_state = state, .target = target})).stored.magnitude);
    EXPECT_EQ(maps[0] == maps[1], target == 0);
  }
}

TEST(ConstantKeys, AreNotTestedBeyondTheLimit) {
  const Scenario scenario = reflectors("", "", "sea: {significant_wave_height_m: [0.1, 3]}");
  const Pipeline pipeline(scenario);
  EXPECT_THAT(constant_key_warnings(pipeline, {.processor_s = 0}),
              ElementsAre(HasSubstr("sea.significant_wave_height_m: not tested whether the maps change")));
  const StopFlag stop = true;
  EXPECT_THROW(constant_key_warnings(pipeline, {.stop = &stop}), Interrupted);
}

TEST(ConstantKeys, AreInNoScenarioOfTheProject) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SEAGLINT_SOURCE_DIR "/scenarios")) {
    // The trials of the fleet's 54 keys, each on 16 targets, and of ships among decoys would take half an hour each.
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".yaml" || name == "fleet" || name == "escort") continue;
    EXPECT_THAT(warnings(read_scenario(entry.path())), IsEmpty()) << entry.path();
  }
}

// Targets enlarged by factors: similarity of echoes and of motion, sums of single bodies, windows of drawn sizes.

constexpr const char* kReflectorMesh = SEAGLINT_SOURCE_DIR "/assets/icosahedral_reflector.glb";

class TargetSizes : public testing::Test {
 protected:
  TargetSizes() {
    write_mesh(folder_.path() / "plate.stl", make_plate(1, 0.6));
    write_mesh(folder_.path() / "sphere.stl", make_sphere(0.5, 3));
  }
  Scenario parse(const std::string& text) const {
    return parse_scenario(text, (folder_.path() / "sizes.yaml").string());
  }

  // One mesh at rest. All frequencies are divided by `slower`, all times and lengths of the radar multiplied by it.
  Scenario at_rest(const std::string& mesh, double scale, double slower) const {
    return parse(fmt::format(R"(
seaglint: 1
radar: {{carrier_ghz: {}, hop_count: 4, hop_step_mhz: {}, bandwidth_mhz: {}, sampling_mhz: {}, pulse_width_us: {}, pri_us: 250, pulses: 8}}
view: {{azimuth_deg: 12, elevation_deg: 3}}
targets:
  t: {{label: 1, mesh: {}, scale: {}}}
map: {{range_span_m: {}}}
dataset: {{maps_per_case: 1, realisations_per_case: 1}}
)",
                             12 / slower, 24 / slower, 24 / slower, 48 / slower, 20 * slower, mesh, scale,
                             30 * slower));
  }

  // The targets in Hs 1 m.
  Scenario in_waves(const std::string& targets, const std::string& more = "") const {
    return parse(fmt::format(R"(
seaglint: 1
radar: {{pulses: 32}}
view: {{azimuth_deg: 30}}
sea: {{significant_wave_height_m: 1, components: 64}}
targets:
{}
dataset: {{maps_per_case: 4, realisations_per_case: 4}}
{}
)",
                             targets, more));
  }

  TemporaryFolder folder_;
};

// Of perfect conductors S(s L, f) = s S(L, s f). A power of two leaves all roundings as they are; others turn the
// principal axes of a sphere, whose curvatures are equal (-46 dB at 3).
TEST_F(TargetSizes, EchoAsTheTargetAtAFrequencyAsManyTimesHigher) {
  const auto error_db = [&](const std::string& mesh, double s) {
    const std::vector<Complex> large = response_of(Pipeline(at_rest(mesh, s, s)), 0);
    std::vector<Complex> expected = response_of(Pipeline(at_rest(mesh, 1, 1)), 0);
    EXPECT_EQ(large.size(), expected.size());
    for (Complex& value : expected) value *= s;
    const double error = relative_difference_db(large, expected);
    fmt::print("{} {} times as large: {:.0f} dB\n", std::filesystem::path(mesh).filename().string(), s, error);
    return error;
  };
  for (const double s : {0.25, 8.0}) EXPECT_LT(error_db("sphere.stl", s), -150) << s;
  for (const double s : {0.25, 3.0, 8.0}) {
    EXPECT_LT(error_db("plate.stl", s), -100) << s;
    EXPECT_LT(error_db(kReflectorMesh, s), -100) << s;
  }
}

// Froude: a float s times as large in a sea s times as large has the same angles, sqrt(s) times as late.
TEST_F(TargetSizes, MoveAlikeInASeaEnlargedAlike) {
  const auto moving = [&](double s, double slower) {
    const Scenario scenario =
        parse(fmt::format(R"(
seaglint: 1
sea: {{significant_wave_height_m: {}, peak_period_s: {}, cutoff_rad_s: {}, second_order_cutoff_rad_s: {}, components: 64, order: 2}}
targets:
  t:
    label: 1
    mesh: sphere.stl
    scale: {}
    layout: {{line: {{count: 2, spacing_m: {}}}}}
    motion: {{model: float, translations: false, step_s: {}, spin_up_s: {}}}
)",
                          0.3 * s, 3 * slower, 8 / slower, 8 / slower, s, 5 * s, 0.02 * slower, 20 * slower));
    return moving_bodies(scenario, {}, 10 * slower);
  };
  const MovingBodies small = moving(1, 1), large = moving(4, 2);
  double largest = 0;
  for (std::size_t b = 0; b < 2; ++b) {
    for (double t = 0; t < 10; t += 0.37) {
      const Vec3 angles = motion_at(small.bodies[b], t).angles;
      EXPECT_LT((motion_at(large.bodies[b], 2 * t).angles - angles).norm(), 1e-9);
      largest = std::max(largest, angles.norm());
    }
    EXPECT_NEAR(bounds(large.bodies[b].mesh).upper.x(), 4 * bounds(small.bodies[b].mesh).upper.x(), 1e-12);
  }
  EXPECT_GT(largest, 0.05);
}

TEST_F(TargetSizes, OfFactorsOfOneLeaveTheBytes) {
  const auto floats = [&](const std::string& keys) {
    return in_waves(fmt::format("  t: {{label: 1, mesh: {}, {} bodies: independent}}, motion: {{model: float}}}}",
                                kReflectorMesh, keys));
  };
  const Pipeline plain(floats("layout: {line: {count: 2},"));
  for (const char* keys : {"layout: {line: {count: 2}, scales: {lowest: 1, highest: 1},",
                           "scale: 0.5, layout: {line: {count: 2}, scales: {lowest: 2, highest: 2},"}) {
    const Pipeline one(floats(keys));
    EXPECT_EQ(one.window_m(), plain.window_m());
    for (std::size_t sample = 0; sample < 2; ++sample)
      EXPECT_EQ(one.generate_sample(sample).stored.magnitude, plain.generate_sample(sample).stored.magnitude);
  }
}

TEST_F(TargetSizes, OfALayoutEchoAsTheSumOfSingleBodies) {
  for (const char* motion : {"fixed", "float"}) {
    const std::string common = fmt::format("mesh: {}, motion: {{model: {}}}", kReflectorMesh, motion);
    const std::string both = fmt::format(
        "  both: {{label: 1, {}, scale: 1.5, layout: {{line: {{count: 2, spacing_m: 40}}, scales: {{lowest: "
        "0.5, highest: 2}}, seed: 3}}}}\n",
        common);
    const std::vector<double> factors = body_scales(in_waves(both).targets[0].layout, 1.5);
    EXPECT_GT(std::abs(factors[0] - factors[1]), 0.1);
    const Pipeline pipeline(
        in_waves(both + fmt::format("  first: {{label: 0, {}, scale: {}, layout: {{line: {{centre_x_m: -20}}}}}}\n"
                                    "  second: {{label: 0, {}, scale: {}, layout: {{line: {{centre_x_m: 20}}}}}}\n",
                                    common, factors[0], common, factors[1])));
    std::vector<Complex> sum = response_of(pipeline, 1);
    const std::vector<Complex> second = response_of(pipeline, 2);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += second[i];
    EXPECT_EQ(response_of(pipeline, 0), sum) << motion;
  }
}

// A raft has the dimensions of its keys: it moves alike with reflectors of any size.
TEST_F(TargetSizes, OfReflectorsLeaveTheMotionOfTheirRaft) {
  const auto raft = [&](const char* scales) {
    return Pipeline(
        in_waves(fmt::format("  t: {{label: 1, mesh: {}, layout: {{line: {{count: 3}}, bodies: rigid{}}}, "
                             "motion: {{model: ship, length_m: 134.6, beam_m: 17.5}}}}",
                             kReflectorMesh, scales)));
  };
  const Pipeline plain = raft(""), sizes = raft(", scales: {lowest: 0.5, highest: 2}");
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(sizes.scene({.realisation = 1})->bodies[0][i].pose(0.01).p,
              plain.scene({.realisation = 1})->bodies[0][i].pose(0.01).p);
    EXPECT_NE(sizes.targets()[0].models[i]->scale, 1);
  }
  EXPECT_NE(response_of(sizes, 0), response_of(plain, 0));
}

// The window is 2.2 times the reach of the largest draw: the plate's half diagonal, 0.583 m times the factor.
TEST_F(TargetSizes, DrawnInEverySeaAreWithinTheWindowAndColumns) {
  const Scenario scenario = in_waves(
      "  t: {label: 1, mesh: plate.stl, scale: uniform(10 90)}\n"
      "  u: {label: 0, mesh: plate.stl, scale: same(targets.t.scale)}",
      "map: {range_span_m: 20}");
  const Pipeline pipeline(scenario);
  double largest = 0;
  for (int realisation = 0; realisation < 4; ++realisation) {
    SampleAddress at;
    at.realisation = realisation;
    const double drawn = pipeline.scenario_of(at).targets[0].scale;
    EXPECT_EQ((*pipeline.scene({.realisation = realisation, .target = 1})->targets)[1].models.front()->scale, drawn);
    const SampleRecord record = pipeline.generate_sample(pipeline.plan().sample(at)).stored.record;
    ASSERT_EQ(record.drawn_numbers.size(), 2u);
    EXPECT_EQ(record.drawn_numbers[0].key, "targets.t.scale");
    EXPECT_EQ(record.drawn_numbers[0].value, drawn);
    largest = std::max(largest, drawn);
  }
  EXPECT_GT(largest, 50);  // the middle of the distribution
  EXPECT_NEAR(pipeline.window_m(), 2.2 * largest * std::hypot(0.5, 0.3), 1e-5 * largest);
  // A drawn size is that size.
  const SampleAddress last{.realisation = 3};
  const Pipeline fixed(pipeline.scenario_of(last), pipeline.plan());
  const PulseTrain train = pipeline.pulse_train(pipeline.plan().sample(last));
  EXPECT_EQ(pipeline.response(last, train).response.values, fixed.response(last, train).response.values);
}

// Of 1.17 m times the factor, below three wavelengths of 1.9 cm.
TEST_F(TargetSizes, ThatAreTooSmallAreWarnedOfOnceForTheSmallestAndTheLargest) {
  const std::string layout = "layout: {line: {count: 9}, scales: {lowest: 0.01, highest: 0.04}}";
  const Scenario scenario = in_waves(
      fmt::format("  t: {{label: 1, mesh: plate.stl, {}}}\n  u: {{label: 0, mesh: plate.stl, scale: 0.05}}", layout));
  const std::vector<double> factors = body_scales(scenario.targets[0].layout, 1);
  const auto [smallest, largest] = std::ranges::minmax(factors);
  const double across_m = std::hypot(1, 0.6);
  EXPECT_THAT(mesh_warnings(Pipeline(scenario)),
              testing::IsSupersetOf(
                  {HasSubstr(fmt::format("targets.t.mesh: the target is {:.3g} m across", smallest * across_m)),
                   HasSubstr(fmt::format("targets.t.mesh, {:.6g} times as large: the target is {:.3g} m across",
                                         largest, largest * across_m))}));
  EXPECT_THAT(mesh_warnings(Pipeline(scenario)),
              testing::Not(testing::Contains(HasSubstr("targets.u.mesh: the target"))));
}

}  // namespace
}  // namespace seaglint

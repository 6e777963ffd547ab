// SPDX-License-Identifier: BSD-3-Clause
// A swept or drawn key that changes nothing is named, and no other.
#include "tools/pipeline/scenario_check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scenario/scenario.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

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
  for (const std::string clutter : {"level: nrl", "doppler: sea_state", "doppler: wave_resolved"}) {
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
  EXPECT_THAT(lines[0], HasSubstr("sea.swell.peak_period_s (uniform(10, 14), once per sea) changes nothing"));
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
  EXPECT_THAT(lines[0], HasSubstr("targets.b.layout.seed (same(targets.a.layout.seed), once per sea) changes nothing"));
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
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_THAT(warnings(read_scenario(entry.path())), IsEmpty()) << entry.path();
  }
}

}  // namespace
}  // namespace seaglint

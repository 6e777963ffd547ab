// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tests/refusal.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// Keys of classes, roles, sizes and solvers of targets, and of the division for learning.

TEST(ScenarioClasses, AreDifferentNamesAndEveryLabelIsOneOfThem) {
  const auto classes = [](const std::string& list) {
    return kShort + std::string("dataset: {classes: ") + list + "}\n";
  };
  EXPECT_EQ(parse_scenario(kShort, "file.yaml").dataset.classes, (std::vector<std::string>{"array", "ship"}));
  const Scenario three = parse_scenario(classes("[decoys, ship, guarded ship]"), "file.yaml");
  EXPECT_EQ(three.dataset.classes, (std::vector<std::string>{"decoys", "ship", "guarded ship"}));
  EXPECT_HAS(effective_yaml(three), "\n  classes: [decoys, ship, \"guarded ship\"]\n");
  EXPECT_THAT(effective_yaml(parse_scenario(classes("[array, ship]"), "file.yaml")), Not(HasSubstr("classes")));

  const std::string first = "folder/file.yaml:4:20: dataset.classes: ", item = "folder/file.yaml:4:";
  EXPECT_EQ(complaint_about(classes("[ship]")), first + "a list: must be a list of 2 to 10 names");
  EXPECT_EQ(complaint_about(classes("[a, b, c, d, e, f, g, h, i, j, k]")),
            first + "a list: must be a list of 2 to 10 names");
  EXPECT_EQ(complaint_about(classes("ship")), first + "value 'ship': must be a list of 2 to 10 names");
  EXPECT_EQ(complaint_about(classes("[my ship, my_ship]")),
            item + "30: dataset.classes.1: value 'my_ship': must differ from the others, also with '_' for a space");
  EXPECT_EQ(complaint_about(classes("[a, 'b,c']")),
            item + "24: dataset.classes.1: value 'b,c': must be 1 to 40 letters, digits, '_', '-' or spaces within");
  EXPECT_EQ(complaint_about(classes("[a, b, c]"), {{"targets.a.label", "3"}}),
            "--set targets.a.label: value '3': must be within 0 and 2, a class of dataset.classes: a, b, c");
  EXPECT_EQ(complaint_about(kShort, {{"targets.a.label", "2"}}),
            "--set targets.a.label: value '2': must be 0 or 1, a class of dataset.classes: array, ship");
  EXPECT_EQ(complaint_about(kShort, {{"targets.a.label", "10"}}),
            "--set targets.a.label: value '10': must be a whole number within 0 and 9");
}

TEST(TargetRoles, PartNeedsNoLabelAndAClassDoes) {
  const std::string decoy = "  d: {role: part, mesh: a.glb}\n";
  const Scenario scenario =
      parse("seaglint: 1\ntargets:\n" + decoy + "  s: {label: 1, mesh: b.glb, companions: [{target: d}]}\n");
  EXPECT_EQ(scenario.targets[0].role, TargetRole::kPart);
  EXPECT_EQ(scenario.targets[1].role, TargetRole::kClass);
  const std::string yaml = effective_yaml(scenario);
  EXPECT_HAS(yaml, "  d:\n    role: part\n    mesh: a.glb\n");
  EXPECT_EQ(effective_yaml(parse(yaml)), yaml);
  EXPECT_HAS(complaint_about(kShort + "  d: {role: class, mesh: a.glb}\n"), "targets.d.label: this key is missing");
}

TEST(TargetRoles, LabelOfAPartIsIgnored) {
  const Scenario scenario =
      parse(kShort + "  s: {label: 1, mesh: b.glb, companions: [{target: a}]}\n", {{"targets.a.role", "part"}});
  EXPECT_HAS(effective_yaml(scenario), "  a:\n    role: part\n    mesh: a.glb\n");
}

TEST(TargetRoles, PartWithoutUseAndScenariosWithoutAClassAreRefused) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"  t: {role: whole, mesh: a.glb}", "13: targets.t.role: value 'whole': must be class or part"},
      {"  t: {role: part, mesh: a.glb}",
       "13: targets.t.role: value 'part': must be the companion of another target, or class"},
      {"  t: {role: part, mesh: a.glb, companions: [{target: a}]}",
       "44: targets.t.companions: not allowed here: valid only with role: class"},
  };
  for (const auto& [line, complaint] : mistakes)
    EXPECT_EQ(complaint_about(kShort + line + "\n"), std::string("folder/file.yaml:4:") + complaint);
  EXPECT_EQ(complaint_about("seaglint: 1\ntargets: {a: {role: part, mesh: a.glb}}\n"),
            "folder/file.yaml:2:10: targets: must have a target of role: class; parts have no samples of their own");
}

TEST(TargetRoles, PartMayBeACompanionByADrawnValueAndIsNotDrawnItself) {
  const std::string parts = "  d: {role: part, mesh: a.glb}\n  e: {role: part, mesh: a.glb}\n";
  EXPECT_EQ(complaint_about(kShort + parts + "  s: {label: 1, mesh: b.glb, companions: [{target: choice(d e)}]}\n"),
            "accepted");
  EXPECT_HAS(complaint_about(kShort + parts + "  s: {label: 1, mesh: b.glb, companions: [{target: d}]}\n"),
             "targets.e.role: value 'part': must be the companion of another target, or class");
  EXPECT_HAS(complaint_about(kShort + "  s: {role: choice(class part), label: 1, mesh: b.glb}\n"),
             "targets.s.role: value 'choice(class part)': must be one value for all maps");
}

TEST(LayoutBodies, AreIndependentUnlessTheyAreRigid) {
  const auto with_layout = [](const std::string& keys) {
    return kShort + "  t: {label: 1, mesh: a.glb, layout: {" + keys + "}}\n";
  };
  EXPECT_EQ(parse(with_layout("line: {}")).targets[1].layout->bodies, LayoutBodies::kIndependent);
  EXPECT_EQ(parse(with_layout("line: {}, bodies: rigid")).targets[1].layout->bodies, LayoutBodies::kRigid);
  EXPECT_EQ(complaint_about(with_layout("line: {}, bodies: welded")),
            "folder/file.yaml:4:57: targets.t.layout.bodies: value 'welded': must be independent or rigid");
  EXPECT_EQ(complaint_about(with_layout("bodies: rigid")),
            "folder/file.yaml:4:38: targets.t.layout.line: this key is missing");
  EXPECT_THAT(effective_yaml(parse(kShort)), Not(HasSubstr("bodies")));
}

std::string complaint(const std::string& target) {
  return complaint_about(kShort + "  t: {label: 1, " + target + "}\n");
}

TEST(ScaleOfATarget, IsOneUnlessItIsGiven) {
  const Scenario scenario = parse(kShort + "  t: {label: 1, mesh: a.glb, scale: 2.5}\n");
  EXPECT_EQ(scenario.targets[0].scale, 1);
  EXPECT_EQ(scenario.targets[1].scale, 2.5);
  EXPECT_EQ(parse(effective_yaml(scenario)).targets[1].scale, 2.5);
}

TEST(ScaleOfATarget, IsPositiveAndOfAMesh) {
  EXPECT_HAS(complaint("mesh: a.glb, scale: 0"),
             "file.yaml:4:37: targets.t.scale: value '0': must be a number within 0.001 and 1000");
  EXPECT_HAS(complaint("mesh: a.glb, scale: -2"),
             "file.yaml:4:37: targets.t.scale: value '-2': must be a number within 0.001 and 1000");
  EXPECT_HAS(complaint("mesh: a.glb, scale: [1, 2]"), "file.yaml:4:37: targets.t.scale: a list: must be");
  EXPECT_HAS(complaint("points: [{position_m: [0, 0, 0]}], scale: 2"),
             "file.yaml:4:59: targets.t.scale: value '2': not allowed here: valid only with a mesh");
}

// Also where the middle of the distribution is the default.
TEST(ScaleOfATarget, IsDrawnOncePerSeaAndSharedByTwins) {
  const Scenario read = parse(kShort +
                              "  t: {label: 1, mesh: a.glb, scale: uniform(0.5 1.5)}\n"
                              "  u: {label: 1, mesh: a.glb, scale: same(targets.t.scale)}\n"
                              "dataset: {maps_per_case: 4, realisations_per_case: 2}\n");
  const Scenario scenario = parse(effective_yaml(read));
  EXPECT_EQ(effective_yaml(scenario), effective_yaml(read));
  const SamplePlan plan(scenario);
  const auto drawn = [&](int realisation, int interval) {
    const Scenario of = plan.drawn(scenario, {.realisation = realisation, .interval = interval});
    EXPECT_EQ(of.targets[1].scale, of.targets[2].scale);
    return of.targets[1].scale;
  };
  EXPECT_EQ(drawn(0, 0), drawn(0, 1));
  EXPECT_NE(drawn(0, 0), drawn(1, 0));
  EXPECT_HAS(complaint("mesh: a.glb, scale: uniform(0 2)"),
             "file.yaml:4:37: targets.t.scale: value '0': must be a number within 0.001 and 1000; where "
             "targets.t.scale, drawn by uniform(0, 2), is 0");
}

// The seed of a layout is written only where it is not 0, the middle of this distribution.
TEST(ScaleOfATarget, OfALayoutIsDrawnWithItsSeed) {
  const Scenario read = parse(kShort +
                              "  t: {label: 1, mesh: a.glb, layout: {line: {count: 2}, scales: {highest: 2}, seed: "
                              "integers(0 1)}}\n");
  EXPECT_HAS(effective_yaml(read), "seed: integers(0, 1)");
  EXPECT_EQ(effective_yaml(parse(effective_yaml(read))), effective_yaml(read));
}

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
  EXPECT_HAS(effective_yaml(parse(kShort)), "method: beams");
}

TEST(SolverMethodKeys, AreRefusedOutsideOfTheirBounds) {
  EXPECT_HAS(complaint_about(with_solver("method: sbr")),
             "6:22: targets.a.solver.method: value 'sbr': must be beams or rays");
  for (const char* spacing : {"9e-6", "1.01", "-0.1"})
    EXPECT_HAS(complaint_about(with_solver(std::string("method: rays, ray_spacing_m: ") + spacing)),
               "targets.a.solver.ray_spacing_m: value '" + std::string(spacing) + "': must be");
  for (const char* spacing : {"0", "1e-5", "1"})
    EXPECT_EQ(complaint_about(with_solver(std::string("method: rays, ray_spacing_m: ") + spacing)), "accepted");
}

TEST(SolverMethodKeys, OfBeamsHaveNoDistanceBetweenRays) {
  const std::string rule = "valid only with method: rays; beams have min_patch_m";
  EXPECT_EQ(complaint_about(with_solver("ray_spacing_m: 0.01")),
            "folder/file.yaml:6:29: targets.a.solver.ray_spacing_m: value '0.01': " + rule);
  EXPECT_EQ(complaint_about(with_solver("method: beams, ray_spacing_m: 0")), "accepted");
  const std::string rays = with_solver("method: rays, ray_spacing_m: 0.01");
  EXPECT_HAS(complaint_about(rays, {{"targets.a.solver.method", "beams"}}), "value '0.01': " + rule);
  EXPECT_THAT(complaint_about(kShort, {{"targets.a.solver.ray_spacing_m", "0.01"}}),
              testing::AllOf(testing::StartsWith("--set targets.a.solver.ray_spacing_m"), HasSubstr(rule)));
}

TEST(LearningSplit, HasAValueOrSeveralOfEachColumn) {
  const SplitSpec split =
      parse(kShort +
            "learning:\n  split:\n    by: data_set\n    hold_out: {sea.peak_period_s: 8:9, target_name: [ring, '4']}\n")
          .learning.split;
  EXPECT_EQ(split.by, "data_set");
  ASSERT_EQ(split.hold_out.size(), 2u);
  EXPECT_EQ(split.hold_out[0].column, "sea.peak_period_s");
  EXPECT_THAT(split.hold_out[0].values, ElementsAre("8:9"));
  EXPECT_EQ(split.hold_out[1].column, "target_name");
  EXPECT_THAT(split.hold_out[1].values, ElementsAre("ring", "4"));
}

TEST(LearningSplit, IsReplacedByOverrides) {
  const std::string text = kShort + "learning: {split: {hold_out: {gamma: 2}}}\n";
  EXPECT_TRUE(parse(text, {{"learning.split.hold_out", "{}"}}).learning.split.hold_out.empty());
  const SplitSpec split = parse(text, {{"learning.split.hold_out.gamma", "[3, 4]"}}).learning.split;
  ASSERT_EQ(split.hold_out.size(), 1u);
  EXPECT_THAT(split.hold_out[0].values, ElementsAre("3", "4"));
}

TEST(LearningSplit, IsRefusedWithItsPlace) {
  const auto complaint = [](const std::string& split) { return complaint_about(kShort + "learning: " + split + "\n"); };
  EXPECT_THAT(complaint("{split: sea}"),
              StartsWith("folder/file.yaml:4:19: learning.split: value 'sea': must be a map"));
  EXPECT_EQ(complaint("{split: {hold_out: [a]}}"),
            "folder/file.yaml:4:30: learning.split.hold_out: a list: must be a map of at most 100 columns with their "
            "values");
  EXPECT_EQ(complaint("{split: {hold_out: {gamma: []}}}"),
            "folder/file.yaml:4:38: learning.split.hold_out.gamma: a list: must be a value or a list of 1 to 1000 "
            "values");
  EXPECT_EQ(complaint("{split: {hold_out: {gamma: [1, {}]}}}"),
            "folder/file.yaml:4:42: learning.split.hold_out.gamma: a map: must be a text of 1 to 4096 printable "
            "characters");
  EXPECT_THAT(complaint("{split: {hold_out: {gamma: 1, gamma: 2}}}"),
              StartsWith("folder/file.yaml:4:41: learning.split.hold_out.gamma: this key appears twice"));
  EXPECT_THAT(complaint("{split: {hold_out: {gamma: 'uniform(1, 2)'}}}"),
              StartsWith("folder/file.yaml:4:38: learning.split.hold_out.gamma: value 'uniform(1, 2)': must be one "
                         "value for all maps"));
}

Scenario small_scenario() {
  Scenario scenario;
  scenario.sea.significant_wave_height_m = {0.1, 1, 2};
  scenario.view.azimuth_deg = {10, 80, 170};
  scenario.targets.resize(2);
  scenario.targets[0].label = 1;
  scenario.dataset.maps_per_case = 6;
  scenario.dataset.realisations_per_case = 3;
  scenario.dataset.interval_spacing_s = 10;
  scenario.dataset.maps_per_shard = 7;
  return scenario;
}

TEST(SamplePlan, CountsMapsPerCaseAndClass) {
  const SamplePlan plan(small_scenario());
  EXPECT_EQ(plan.size(), 3u * 3u * 2u * 6u);
  std::map<std::tuple<int, int, int>, int> maps_of_case_and_class;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const SampleAddress at = plan.address(i);
    ++maps_of_case_and_class[{at.sea_state, at.view, at.target}];
  }
  EXPECT_EQ(maps_of_case_and_class.size(), 18u);
  for (const auto& [key, count] : maps_of_case_and_class) EXPECT_EQ(count, 6);
}

// Maps of one interval and target are adjacent; intervals keep their order.
TEST(SamplePlan, DividesAnIntervalIntoMaps) {
  Scenario scenario = small_scenario();
  const SamplePlan single(scenario);
  scenario.dataset.maps_per_interval = 3;
  scenario.dataset.maps_per_case = 18;
  const SamplePlan plan(scenario);
  ASSERT_EQ(plan.size(), 3 * single.size());
  EXPECT_EQ(plan.intervals(), single.intervals());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    SampleAddress at = plan.address(i);
    EXPECT_EQ(plan.sample(at), i);
    EXPECT_EQ(at.clutter, static_cast<int>(i % 3));
    EXPECT_EQ(plan.first_of_interval(i), i - i % 3);
    EXPECT_EQ(plan.group(plan.sea_address(i)), plan.group(at));
    at.clutter = 0;
    EXPECT_EQ(at, single.address(i / 3));
  }
}

TEST(SamplePlan, PartsHaveNoSamples) {
  Scenario scenario = small_scenario();
  scenario.targets.insert(scenario.targets.begin() + 1, TargetSpec{});
  scenario.targets[1].role = TargetRole::kPart;
  const SamplePlan plan(scenario), without(small_scenario());
  EXPECT_EQ(plan.classes(), (std::vector<int>{0, 2}));
  ASSERT_EQ(plan.size(), without.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    SampleAddress at = plan.address(i);
    EXPECT_EQ(plan.sample(at), i);
    at.target /= 2;
    EXPECT_EQ(at, without.address(i));
  }
  EXPECT_THROW(plan.sample({0, 0, 0, 0, 1}), std::logic_error);
}

TEST(SamplePlan, NumbersEveryAddressOnce) {
  const SamplePlan plan(small_scenario());
  std::set<std::tuple<int, int, int, int, int>> addresses;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const SampleAddress at = plan.address(i);
    addresses.insert({at.sea_state, at.realisation, at.view, at.interval, at.target});
    EXPECT_EQ(plan.sample(at), i);
    const SampleAddress sea = plan.sea_address(i);
    EXPECT_EQ(sea.sea_state, at.sea_state);
    EXPECT_EQ(sea.realisation, at.realisation);
    EXPECT_EQ(plan.group(sea), plan.group(at));
  }
  EXPECT_EQ(addresses.size(), plan.size());
}

TEST(SamplePlan, ShardsCoverAllSamplesInOrder) {
  const SamplePlan plan(small_scenario());
  std::size_t next = 0;
  for (std::size_t i = 0; i < plan.shards(); ++i) {
    EXPECT_EQ(plan.shard(i).first, next);
    EXPECT_LE(plan.shard(i).count, 7u);
    next += plan.shard(i).count;
  }
  EXPECT_EQ(next, plan.size());
}

TEST(SamplePlan, BothClassesAndAllViewsHaveTheSeaOfTheirGroup) {
  const SamplePlan plan(small_scenario());
  std::map<std::int64_t, std::set<std::uint64_t>> seas_of_group;
  std::map<std::int64_t, std::set<std::pair<int, int>>> uses_of_group;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const SampleAddress at = plan.address(i);
    seas_of_group[plan.group(at)].insert(
        sea_key(static_cast<std::size_t>(at.sea_state), static_cast<std::size_t>(at.realisation)));
    uses_of_group[plan.group(at)].insert({at.view, at.target});
  }
  EXPECT_EQ(seas_of_group.size(), 9u);
  for (const auto& [group, seas] : seas_of_group) EXPECT_EQ(seas.size(), 1u);
  for (const auto& [group, uses] : uses_of_group) EXPECT_EQ(uses.size(), 6u);
}

TEST(SamplePlan, ClassIsIndependentOfParityAndNeighbour) {
  Scenario scenario = small_scenario();
  scenario.dataset.maps_per_case = 300;
  const SamplePlan plan(scenario);
  const auto samples = static_cast<double>(plan.size());
  int even_ships = 0, changes = 0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (i % 2 == 0) even_ships += plan.address(i).target == 0 ? 1 : 0;
    if (i % 2 == 1) changes += plan.address(i).target != plan.address(i - 1).target ? 1 : 0;
  }
  // Binomial with n = 2700, p = 1/2: four standard deviations are 2 sqrt(n). Half of each block of 600 being ships
  // moves the chance of a change from 1/2 to 300/599, 2.3 of 2700.
  EXPECT_NEAR(even_ships, samples / 4, 2 * std::sqrt(samples / 2));
  EXPECT_NEAR(changes, samples / 4, 2 * std::sqrt(samples / 2) + 3);
}

TEST(SamplePlan, SamplesOfOneSeaAreContiguous) {
  const SamplePlan plan(small_scenario());
  std::int64_t last = 0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    EXPECT_GE(plan.group(plan.address(i)), last);
    last = plan.group(plan.address(i));
  }
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Seas as they occur: wave height and period by steepness, and pairs of a scatter diagram.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dispersion.h"
#include "sim/core/process/file.h"
#include "sim/scenario/cases.h"
#include "sim/scenario/files/tables.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tests/sim/scenario/parsing.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using namespace testing_scenarios;
using testing::ElementsAre;
using testing::HasSubstr;

// DNV-RP-C205, 3.5.4.1: Sp = 2 pi Hs / (g Tp^2).
double steepness_of(const SeaState& state) {
  return 2 * kPi * state.significant_wave_height_m / (kGravity * state.peak_period_s * state.peak_period_s);
}

TEST(Steepness, GivesThePeakPeriodOfEachWaveHeight) {
  const Scenario scenario =
      parse(kShort + "sea: {significant_wave_height_m: [0.5, 2], steepness: [0.02, 0.05], gamma: dnv_rule}\n");
  const std::vector<SeaState> states = sea_states(scenario.sea);
  ASSERT_EQ(states.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(states[i].significant_wave_height_m, i < 2 ? 0.5 : 2);
    EXPECT_NEAR(steepness_of(states[i]), i % 2 == 0 ? 0.02 : 0.05, 1e-15);
  }
  EXPECT_NEAR(states[3].peak_period_s, 5.0616, 1e-4);  // sqrt(4 pi / (9.81 0.05)), by hand
  const std::string yaml = effective_yaml(scenario);
  EXPECT_THAT(yaml, HasSubstr("  steepness: [0.02, 0.05]\n"));
  EXPECT_EQ(effective_yaml(parse(yaml)), yaml);
}

// No combination of both breaks: Hs = L/7 is a steepness of 1/7, beyond the bound of the key.
TEST(Steepness, IsDrawnWithAnyWaveHeight) {
  const Scenario scenario = parse(kShort +
                                  "sea: {significant_wave_height_m: uniform(0.1 6), steepness: uniform(0.005 0.14)}\n"
                                  "dataset: {maps_per_case: 300, realisations_per_case: 300}\n");
  const SamplePlan plan(scenario);
  double lowest = 1, highest = 0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const SeaState state = plan.sea_state(plan.address(i));
    lowest = std::min(lowest, steepness_of(state));
    highest = std::max(highest, steepness_of(state));
    EXPECT_LT(state.significant_wave_height_m, breaking_height(2 * kPi / state.peak_period_s));
  }
  EXPECT_GT(lowest, 0.005);
  EXPECT_LT(lowest, 0.01);
  EXPECT_GT(highest, 0.13);
  EXPECT_LT(highest, 0.14);
}

TEST(Steepness, IsRefusedWhereItHasNoPeakPeriod) {
  const std::pair<const char*, const char*> cases[] = {
      {"sea: {steepness: 0.04, peak_period_s: 8}\n",
       "sea.steepness: value '0.04': not allowed here: valid only without sea.peak_period_s"},
      {"sea: {steepness: 0.2}\n", "sea.steepness: value '0.2': must be"},
      {"sea: {steepness: 0}\n", "sea.steepness: value '0': must be"},
      {"sea: {steepness: 0.04, significant_wave_height_m: 0}\n", "must be greater than 0 with sea.steepness"},
      {"sea: {steepness: 0.14, significant_wave_height_m: 0.01}\n",
       "sea.steepness: value '0.14': gives a peak period of 0.2139 s at 0.01 m: must be within 0.5 and 40 s"},
      {"sea: {spectrum: table, table: s.csv, steepness: 0.04}\n", "sea.table"}};
  for (const auto& [sea, message] : cases) EXPECT_THAT(complaint_about(kShort + sea), HasSubstr(message)) << sea;
}

// A diagram of 100 counts, of which 5 lie where waves break: at 4 to 6 s regular waves break above 3.57 m.
class DrawnPairs : public testing::Test {
 protected:
  DrawnPairs() {
    fs::copy_file(SEAGLINT_SOURCE_DIR "/tests/cases/tables/scatter_synthetic.csv", folder_.path() / "seas.csv");
  }
  Scenario read(const std::string& sea, const std::string& more = "") const {
    return parse_scenario("seaglint: 1\nsea: {" + sea + "}\n" + more +
                              "targets:\n  a: {label: 1, mesh: a.glb}\n  b: {label: 0, mesh: b.glb}\n"
                              "dataset: {maps_per_case: 400, realisations_per_case: 200}\n",
                          folder_.path() / "s.yaml");
  }
  std::string refusal(const std::string& sea, const std::string& more = "") const {
    try {
      read(sea, more);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  const TemporaryFolder folder_;
};

TEST_F(DrawnPairs, AreThoseOfTheDiagramAndCommonToARealisation) {
  const Scenario scenario = read("scatter_diagram: seas.csv");
  ASSERT_EQ(scenario.variations.size(), 2u);
  EXPECT_EQ(scenario.variations[0].key_path, "sea.peak_period_s");
  EXPECT_EQ(scenario.variations[1].key_path, "sea.significant_wave_height_m");
  const SamplePlan plan(scenario);
  std::map<int, std::set<std::pair<double, double>>> pairs;
  std::map<std::pair<int, int>, int> cells;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const SampleAddress at = plan.address(i);
    const SeaState state = plan.sea_state(at);
    EXPECT_LT(state.significant_wave_height_m, breaking_height(2 * kPi / state.peak_period_s));
    pairs[at.realisation].insert({state.significant_wave_height_m, state.peak_period_s});
    ++cells[{static_cast<int>(state.significant_wave_height_m), static_cast<int>(state.peak_period_s / 2)}];
  }
  ASSERT_EQ(pairs.size(), 200u);
  for (const auto& [realisation, of_one] : pairs) EXPECT_EQ(of_one.size(), 1u) << realisation;
  std::set<std::pair<double, double>> all;
  for (const auto& [realisation, of_one] : pairs) all.insert(*of_one.begin());
  EXPECT_EQ(all.size(), 200u);
  // The heights 0 to 1, 1 to 2, 2 to 3 m by the periods 4 to 6, 6 to 8, 8 to 10 s: the cells with counts.
  std::set<std::pair<int, int>> drawn;
  for (const auto& [cell, count] : cells) drawn.insert(cell);
  EXPECT_THAT(drawn, ElementsAre(std::pair(0, 2), std::pair(0, 3), std::pair(1, 2), std::pair(1, 3), std::pair(1, 4),
                                 std::pair(2, 3), std::pair(2, 4)));
}

TEST_F(DrawnPairs, LeaveOutTheCellsInWhichWavesBreakAndStateTheirPart) {
  const auto diagram_of = [](const Scenario& scenario) { return *scenario.variations.back().distribution.diagram; };
  // The steepest corner of 3 to 4 m at 4 s: L/7 = 3.57 m < 4 m.
  EXPECT_EQ(diagram_of(read("scatter_diagram: seas.csv")).excluded_cells, 2u);
  EXPECT_NEAR(diagram_of(read("scatter_diagram: seas.csv")).excluded_fraction, 0.05, 1e-12);
  // In 2 m of water waves of 4, 6 and 8 s break above 1.51, 1.66 and 1.72 m (Miche).
  EXPECT_NEAR(diagram_of(read("scatter_diagram: seas.csv, depth_m: 2, order: 1")).excluded_fraction, 0.7, 1e-12);
  EXPECT_NEAR(diagram_of(read("scatter_diagram: seas.csv, depth_m: uniform(2 50), order: 1")).excluded_fraction, 0.7,
              1e-12);
  write_file(folder_.path() / "seas.csv", "Hs/Tp,1,2\n6,1,1\n7,2,2\n");
  EXPECT_THAT(refusal("scatter_diagram: seas.csv"),
              HasSubstr("sea.scatter_diagram: value 'seas.csv': all of its seas break"));
}

TEST_F(DrawnPairs, AreWrittenAsTheirFile) {
  const Scenario scenario = read("scatter_diagram: seas.csv, gamma: uniform(1 5)");
  const std::string yaml = effective_yaml(scenario);
  EXPECT_THAT(yaml, HasSubstr("  scatter_diagram: seas.csv\n"));
  EXPECT_THAT(yaml, testing::Not(HasSubstr("\n  significant_wave_height_m:")));
  EXPECT_THAT(yaml, testing::Not(HasSubstr("\n  peak_period_s:")));
  EXPECT_EQ(effective_yaml(parse_scenario(yaml, folder_.path() / "t.yaml")), yaml);
  for (const char* mesh : {"a.glb", "b.glb"}) write_file(folder_.path() / mesh, "x");
  const std::vector<InputFile> files = input_files(scenario);
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[0].key, "sea.scatter_diagram");
  EXPECT_EQ(files[0].path, folder_.path() / "seas.csv");
}

TEST_F(DrawnPairs, AreReplacedByHeightsAndPeriodsOfSetAndReplaceThem) {
  const Scenario scenario = read("scatter_diagram: seas.csv");
  const std::string yaml = effective_yaml(scenario), file = folder_.path() / "t.yaml";
  const Scenario fixed =
      parse_scenario(yaml, file, {{"sea.peak_period_s", "7"}, {"sea.significant_wave_height_m", "[1, 2]"}});
  EXPECT_TRUE(fixed.variations.empty());
  EXPECT_EQ(fixed.sea.significant_wave_height_m, (Sweep{1, 2}));
  EXPECT_EQ(fixed.sea.peak_period_s, Sweep{7});
  EXPECT_EQ(effective_yaml(parse_scenario(effective_yaml(fixed), file, {{"sea.scatter_diagram", "seas.csv"}})), yaml);
}

// Tables of Tz or Te, as those of classification societies: the peak period of each pair follows from its mean period.
TEST_F(DrawnPairs, OfMeanPeriodsHaveTheirPeakPeriods) {
  const std::pair<const char*, double (*)(double)> kinds[] = {{"zero_crossing_period_s", zero_crossing_period_ratio},
                                                              {"energy_period_s", energy_period_ratio}};
  for (const auto& [key, ratio] : kinds) {
    write_file(folder_.path() / "seas.csv",
               fmt::format("Hs/{},6,8\n0.5,10,20\n1.5,20,10\n", std::string(key) == kinds[0].first ? "Tz" : "Te"));
    const Scenario scenario = read("scatter_diagram: seas.csv, gamma: 2");
    const SamplePlan plan(scenario);
    for (const int realisation : {0, 7, 199}) {
      const SeaState state = plan.sea_state({.realisation = realisation});
      const double mean_period_s = ratio(2) * state.peak_period_s;
      EXPECT_GE(mean_period_s, 5 * (1 - 1e-9)) << key;
      EXPECT_LE(mean_period_s, 9 * (1 + 1e-9)) << key;
    }
    const auto drawn = std::ranges::find(scenario.variations, fmt::format("sea.{}", key), &Variation::key_path);
    ASSERT_NE(drawn, scenario.variations.end()) << key;
    const double drawn_s = std::get<double>(drawn_value(*drawn, scenario.seed, plan.draw_place({.realisation = 7})));
    EXPECT_NEAR(drawn_s, ratio(2) * plan.sea_state({.realisation = 7}).peak_period_s, 1e-9) << key;
    EXPECT_EQ(effective_yaml(parse_scenario(effective_yaml(scenario), folder_.path() / "t.yaml")),
              effective_yaml(scenario));
  }
}

TEST_F(DrawnPairs, AreRefusedBesideOtherHeightsAndPeriods) {
  for (const char* other :
       {"significant_wave_height_m: 1", "peak_period_s: 8", "peak_period_s: uniform(7 9)", "steepness: 0.04"}) {
    const std::string message = refusal(fmt::format("scatter_diagram: seas.csv, {}", other));
    EXPECT_THAT(message, HasSubstr("not allowed here: sea.scatter_diagram gives wave heights and periods")) << other;
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
  }
  EXPECT_THAT(refusal("scatter_diagram: sees.csv"), HasSubstr("did you mean 'seas.csv'?"));
  EXPECT_THAT(refusal("scatter_diagram: choice(seas.csv other.csv)"), HasSubstr("must be one value for all maps"));
  EXPECT_THAT(refusal("scatter_diagram: [seas.csv]"), HasSubstr("sea.scatter_diagram: a list: must be a text"));
  EXPECT_THAT(refusal("scatter_diagram: seas.csv, spectrum: table, table: seas.csv"), HasSubstr("seas.csv"));
  // What some of its pairs contradict is named with one.
  EXPECT_THAT(refusal("scatter_diagram: seas.csv, cutoff_rad_s: 1.4"),
              HasSubstr("where sea.scatter_diagram has waves of 1 m with peak_period_s 4"));
}

}  // namespace
}  // namespace seaglint

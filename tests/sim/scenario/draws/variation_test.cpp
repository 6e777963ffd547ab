// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dispersion.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/words.h"
#include "sim/scenario/cases.h"
#include "sim/scenario/draws/variation.h"
#include "sim/scenario/files/tables.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tests/refusal.h"
#include "tests/sim/scenario/parsing.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Drawn values: their distributions against closed moments, where they are drawn, what they depend on, how they are
// written and refused.

constexpr int kDraws = 40000;

std::vector<std::string> draws_of(const std::string& text) {
  const Distribution distribution = parse_distribution(text).value();
  std::vector<std::string> values;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    Random random({7, Stream::kTest, i});
    values.push_back(text_of(distribution.draw(random)));
  }
  return values;
}

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& value : draws_of(text)) numbers.push_back(parse_number(value).value());
  return numbers;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  const double centre = mean(values);
  double sum = 0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// Mean and deviation within five standard errors; those of a deviation are at most its own over sqrt(2 n), which holds
// for tails up to the normal one.
void expect_moments(const std::string& text, double expected_mean, double expected_deviation) {
  const std::vector<double> values = numbers_of(text);
  EXPECT_NEAR(mean(values), expected_mean, 5 * expected_deviation / std::sqrt(kDraws)) << text;
  EXPECT_NEAR(deviation(values), expected_deviation, 5 * expected_deviation / std::sqrt(2.0 * kDraws)) << text;
}

TEST(Distribution, HasTheMomentsOfItsDefinition) {
  expect_moments("uniform(5, 9)", 7, 4 / std::sqrt(12.0));
  expect_moments("uniform(-1.5,-0.5)", -1, 1 / std::sqrt(12.0));
  expect_moments("normal(10, 2)", 10, 2);
  expect_moments("integers(3, 30)", 16.5, std::sqrt((28.0 * 28 - 1) / 12));
  // (b - a) / L and the second moment (b^2 - a^2) / (2 L) with L = ln(b / a).
  const double length = std::log(20.0), average = 1.9 / length, square = (4 - 0.01) / (2 * length);
  expect_moments("loguniform(0.1, 2)", average, std::sqrt(square - average * average));
  // Truncated at one deviation on both sides: 1 - 2 phi(1) / (2 Phi(1) - 1).
  expect_moments("normal(0, 1, -1, 1)", 0, std::sqrt(1 - 2 * 0.24197072451914337 / 0.6826894921370859));
}

TEST(Distribution, OfChoicesDrawsEachEquallyOften) {
  std::map<std::string, int> counts;
  for (const std::string& value : draws_of("choice(random, costas, linear, 4.5)")) ++counts[value];
  ASSERT_EQ(counts.size(), 4u);
  const double error = std::sqrt(kDraws * 0.25 * 0.75);
  for (const auto& [value, count] : counts) EXPECT_NEAR(count, kDraws / 4.0, 5 * error) << value;
}

TEST(Distribution, DrawsStayWithinItsEnds) {
  for (const char* text : {"uniform(5, 9)", "loguniform(0.1, 2)", "normal(3, 1)", "normal(0, 5, 1, 2)",
                           "integers(1, 3)", "uniform(0.1, 0.30000000000000004)"}) {
    const std::vector<std::string> ends = parse_distribution(text)->ends();
    const double low = parse_number(ends[0]).value(), high = parse_number(ends[1]).value();
    const std::vector<double> values = numbers_of(text);
    EXPECT_GE(std::ranges::min(values), low) << text;
    EXPECT_LE(std::ranges::max(values), high) << text;
    const double middle = parse_number(parse_distribution(text)->middle()).value();
    EXPECT_TRUE(low <= middle && middle <= high) << text;
  }
  const std::vector<double> whole = numbers_of("integers(1, 3)");
  for (const double end : {1.0, 2.0, 3.0}) EXPECT_GT(std::ranges::count(whole, end), kDraws / 4) << end;
}

TEST(Distribution, IsWrittenAsItWasRead) {
  for (const char* text : {"uniform(5, 9)", "normal(3, 1, 2, 4)", "choice(a, b-c, 4)", "loguniform(1e-3, 1e3)"}) {
    const Distribution read = parse_distribution(text).value();
    EXPECT_EQ(read.text(), text);
    EXPECT_EQ(parse_distribution(read.text())->values, read.values);
  }
  EXPECT_EQ(parse_distribution("uniform(5 9)")->text(), "uniform(5, 9)");
  EXPECT_EQ(parse_distribution("uniform( 5 ,9 )")->text(), "uniform(5, 9)");
}

TEST(Distribution, OfOtherTextsIsNone) {
  for (const char* text : {"", "5", "uniform", "Uniform(1, 2)", "ship (old)", "(1, 2)", "5:9:1", "uniform [1, 2]"})
    EXPECT_FALSE(parse_distribution(text)) << text;
}

TEST(Distribution, WithoutMassIsRefusedWithItsForm) {
  const std::map<std::string, std::string> wrong = {
      {"uniform(9, 5)", "a < b"},
      {"uniform(5, 5)", "a < b"},
      {"uniform(5)", "a < b"},
      {"uniform(5, 9", "in quotes or with blanks for commas"},
      {"uniform(5, nan)", "a < b"},
      {"uniform(1e999, 2)", "a < b"},
      {"loguniform(0, 2)", "0 < a < b"},
      {"loguniform(-1, 2)", "0 < a < b"},
      {"normal(1, 0)", "std > 0"},
      {"normal(1, 1, 3, 2)", "low < high"},
      {"normal(0, 1, 10, 11)", "at least 1 %"},
      {"integers(1.5, 3)", "whole numbers"},
      {"integers(0, 9999999999)", "whole numbers"},
      {"choice(a)", "2 to 1000 different"},
      {"choice(a, a)", "2 to 1000 different"},
      {"choice()", "2 to 1000 different"},
      {"choice(a, " + std::string(65, 'b') + ")", "at most 64 bytes"},
  };
  for (const auto& [text, reason] : wrong) EXPECT_HAS(refusal_of([&] { parse_distribution(text); }), reason) << text;
}

const std::string kDrawn = R"yaml(seaglint: 1
view: {azimuth_deg: uniform(10 170), elevation_deg: 2}
sea:
  significant_wave_height_m: loguniform(0.2, 2)
  peak_period_s: uniform(7, 10)
radar: {hop_code: "choice(random, balanced)"}
clutter: {scr_db: uniform(10 25)}
targets:
  ship: {label: 1, mesh: a.glb}
  array: {label: 0, mesh: b.glb, layout: {line: {count: "integers(3, 30)", spacing_m: 20}}}
dataset: {maps_per_case: 12, realisations_per_case: 4}
)yaml";

std::string replaced(const std::string& text, const std::string& from, const std::string& by) {
  const std::size_t at = text.find(from);
  return text.substr(0, at) + by + text.substr(at + from.size());
}

Scenario drawn(const Scenario& scenario, std::size_t sample) {
  const SamplePlan plan(scenario);
  return plan.drawn(scenario, plan.address(sample));
}

TEST(Variation, FieldsHaveTheMiddlesOfTheirDistributions) {
  const Scenario scenario = parse(kDrawn);
  ASSERT_EQ(scenario.variations.size(), 6u);
  EXPECT_EQ(scenario.view.azimuth_deg, std::vector<double>{90});
  EXPECT_EQ(scenario.clutter.scr_db, 17.5);
  EXPECT_EQ(scenario.targets[1].layout->line->count, 16);
  EXPECT_EQ(scenario.radar.hop_code, HopCode::kRandom);
}

// Those of the sea once per sea, the others once per interval; both targets see the same.
TEST(Variation, IsDrawnPerSeaOrPerObservation) {
  const Scenario scenario = parse(kDrawn);
  const SamplePlan plan(scenario);
  std::set<std::tuple<int, double, int>> seas;
  std::set<std::tuple<int, int, double, double>> observations;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const SampleAddress at = plan.address(i);
    const Scenario one = plan.drawn(scenario, at);
    EXPECT_TRUE(one.variations.empty());
    EXPECT_EQ(plan.sea_state(at).significant_wave_height_m, one.sea.significant_wave_height_m[0]);
    EXPECT_EQ(plan.view(at).azimuth_deg, one.view.azimuth_deg[0]);
    seas.insert({at.realisation, one.sea.significant_wave_height_m[0], one.targets[1].layout->line->count});
    observations.insert({at.realisation, at.interval, one.view.azimuth_deg[0], one.clutter.scr_db});
  }
  EXPECT_EQ(seas.size(), 4u);
  EXPECT_EQ(observations.size(), 12u);
}

// Maps of one interval have one view and one sea, and a clutter each.
TEST(Variation, OfClutterIsDrawnPerMap) {
  const Scenario scenario =
      parse(kDrawn, {Override{"dataset.maps_per_case", "12"}, Override{"dataset.maps_per_interval", "3"}});
  const SamplePlan plan(scenario);
  std::set<double> views, ratios;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    views.insert(drawn(scenario, i).view.azimuth_deg[0]);
    ratios.insert(drawn(scenario, i).clutter.scr_db);
  }
  EXPECT_EQ(views.size(), 4u);
  EXPECT_EQ(ratios.size(), 12u);
}

// A key's draws depend on the seed, the key and the number alone.
TEST(Variation, IsIndependentOfOtherKeysAndOfTheirOrder) {
  const Scenario scenario = parse(kDrawn);
  const Scenario fewer =
      parse(replaced(replaced(kDrawn, "scr_db: uniform(10 25)", "scr_db: 20"), "uniform(7, 10)", "8"));
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_EQ(drawn(scenario, i).view.azimuth_deg, drawn(fewer, i).view.azimuth_deg);
    EXPECT_EQ(drawn(scenario, i).targets[1].layout->line->count, drawn(fewer, i).targets[1].layout->line->count);
    EXPECT_EQ(drawn(fewer, i).clutter.scr_db, 20);
  }
  const Scenario seeded = parse(kDrawn, {Override{"seed", "43"}});
  EXPECT_NE(drawn(scenario, 0).view.azimuth_deg, drawn(seeded, 0).view.azimuth_deg);
}

// Draws set the members of the table of fields: whatever key is drawn, the scenario is that with its value in the file.
TEST(Variation, GivesTheScenarioThatIsReadWithTheDrawnValues) {
  const std::string text = R"yaml(seaglint: 1
view: {azimuth_deg: uniform(10 170), elevation_deg: loguniform(1 5)}
radar: {hop_code: choice(random balanced stepped), pri_jitter_us: uniform(0 20), polarisation: choice(hh vv)}
sea:
  peak_period_s: choice(dnv_wind_sea 8 9.50)
  gamma: choice(1 2.5 dnv_rule)
  depth_m: uniform(20 50)
  components: integers(10 20)
  coming_from_deg: normal(100 5)
  swell: {significant_wave_height_m: uniform(0.1 0.3), energy_period_s: uniform(9 11), coming_from_deg: uniform(0 90)}
sea_reflection: {enabled: choice(true false), temperature_c: normal(10 2 5 15)}
targets:
  ship: {label: 1, mesh: choice(a.glb b.glb), scale: uniform(0.5 2), material: choice(pec steel), motion: {model: choice(ship rao), roll_damping: uniform(0 1)}, solver: {crease_deg: choice(auto 10), edges: choice(true false)}}
  array:
    label: 0
    mesh: b.glb
    unit: choice(m cm)
    orientation: {forward: choice(+x -x)}
    layout: {area: {shape: choice(ring random), count: integers(3 30)}, heights: {lowest_m: uniform(0 1), highest_m: uniform(1 2)}, seed: integers(0 1000000)}
  points: {label: 0, points: [{position_m: [0, 0, 0]}, {position_m: [1, 0, 0], amplitude_m: uniform(1 2)}]}
  other: {label: 0, mesh: b.glb, motion: {roll_damping: same(targets.ship.motion.roll_damping)}}
clutter: {scr_db: uniform(10 25), sea_state: uniform(1 3), enabled: choice(true false)}
dataset: {maps_per_case: 12, realisations_per_case: 4}
)yaml";
  const Scenario scenario = parse(text);
  const SamplePlan plan(scenario);
  for (std::size_t sample = 0; sample < plan.size(); ++sample) {
    const DrawPlace place = plan.draw_place(plan.address(sample));
    std::vector<Override> values;
    for (const Variation& variation : scenario.variations)
      values.push_back({variation.key_path, text_of(drawn_value(variation, scenario.seed, place))});
    const Scenario one = drawn_scenario(scenario, place);
    EXPECT_TRUE(one == parse(text, values)) << sample;
    EXPECT_FALSE(one == scenario);
  }
}

TEST(Variation, OfAScenarioWithoutDistributionsIsNone) {
  const Scenario scenario = parse(kPaper);
  EXPECT_TRUE(scenario.variations.empty());
  EXPECT_EQ(effective_yaml(drawn(scenario, 5)), effective_yaml(scenario));
}

TEST(Variation, IsWrittenAndReadBack) {
  const Scenario scenario = parse(kDrawn);
  const std::string text = effective_yaml(scenario);
  EXPECT_THAT(text, AllOf(HasSubstr("azimuth_deg: uniform(10, 170)"), HasSubstr("count: integers(3, 30)"),
                          HasSubstr("hop_code: choice(random, balanced)")));
  const Scenario again = parse(text);
  for (std::size_t i = 0; i < scenario.variations.size(); ++i)
    EXPECT_EQ(again.variations.at(i).key_path, scenario.variations[i].key_path);
  EXPECT_EQ(effective_yaml(again), text);
  for (const std::size_t i : {0u, 7u, 20u})
    EXPECT_EQ(effective_yaml(drawn(again, i)), effective_yaml(drawn(scenario, i)));
  // The drawn scenario is one without distributions, and reads as such.
  EXPECT_EQ(effective_yaml(parse(effective_yaml(drawn(scenario, 3)))), effective_yaml(drawn(scenario, 3)));
}

TEST(Variation, IsSetAndReplacedByOverrides) {
  const Scenario scenario =
      parse(kPaper, {Override{"clutter.scr_db", "uniform(10, 25)"}, Override{"sea.peak_period_s", "choice(8, 9)"}});
  EXPECT_EQ(scenario.variations.size(), 2u);
  EXPECT_TRUE(parse(kDrawn, {Override{"view.azimuth_deg", "30"}}).variations.size() == 5);
}

TEST(Variation, OutsideOfItsKeysBoundIsRefusedAtItsLine) {
  EXPECT_THAT(complaint_about(kDrawn, {Override{"view.elevation_deg", "uniform(2, 95)"}}),
              AllOf(HasSubstr("view.elevation_deg"), HasSubstr("95"), HasSubstr("drawn by uniform(2, 95)")));
  EXPECT_THAT(complaint_about(replaced(kDrawn, "integers(3, 30)", "integers(0, 30)")),
              AllOf(HasSubstr("file.yaml:10:"), HasSubstr("targets.array.layout.line.count")));
  EXPECT_THAT(complaint_about(replaced(kDrawn, "uniform(7, 10)", "uniform(10, 7)")),
              AllOf(HasSubstr("file.yaml:5:18: sea.peak_period_s: value 'uniform(10, 7)'"), HasSubstr("a < b")));
  EXPECT_THAT(complaint_about(replaced(kDrawn, "balanced", "balancd")),
              AllOf(HasSubstr("radar.hop_code"), HasSubstr("balancd")));
}

TEST(Variation, OfAKeyThatIsCommonToAllMapsIsRefused) {
  for (const Override& set :
       {Override{"seed", "integers(1, 9)"}, Override{"map.range_span_m", "uniform(100, 200)"},
        Override{"radar.pulses", "integers(9, 99)"}, Override{"dataset.maps_per_case", "integers(1, 9)"},
        Override{"targets.ship.label", "choice(0, 1)"}})
    EXPECT_HAS(complaint_about(kDrawn, {set}), "must be one value for all maps") << set.key_path;
}

TEST(Variation, WithinAListIsRefused) {
  EXPECT_HAS(complaint_about(kDrawn, {Override{"view.elevation_deg", "[1, 'uniform(2, 3)']"}}),
             "view.elevation_deg.1: value 'uniform(2, 3)': a distribution cannot be one of a list");
}

// Waves of 7 m and 5 s are steeper than 1/7, each of them alone at the middle of the other is not.
TEST(Variation, ThatContradictsAnotherIsRefusedWithItsValues) {
  const Scenario scenario = parse(
      kShort + "dataset: {maps_per_case: 200, realisations_per_case: 200}\n",
      {Override{"sea.significant_wave_height_m", "uniform(0.1, 7)"}, Override{"sea.peak_period_s", "uniform(5, 15)"}});
  try {
    for (std::size_t i = 0; i < 200; ++i) drawn(scenario, i);
    ADD_FAILURE() << "no sea was refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("drawn values"), HasSubstr("sea.peak_period_s")));
  }
}

// Twins with one layout in each sea.
TEST(Variation, SameHasTheDrawsOfAnotherKey) {
  const std::string twin =
      "  twin: {label: 1, mesh: b.glb, layout: {line: {count: same(targets.array.layout.line.count), spacing_m: "
      "20}}}\n";
  const Scenario scenario = parse(replaced(kDrawn, "dataset:", twin + "dataset:"));
  std::set<int> counts;
  for (std::size_t i = 0; i < SamplePlan(scenario).size(); ++i) {
    const Scenario one = drawn(scenario, i);
    EXPECT_EQ(one.targets[1].layout->line->count, one.targets[2].layout->line->count);
    counts.insert(one.targets[1].layout->line->count);
  }
  EXPECT_GT(counts.size(), 1u);
  EXPECT_HAS(effective_yaml(scenario), "count: same(targets.array.layout.line.count)\n");
  EXPECT_EQ(effective_yaml(parse(effective_yaml(scenario))), effective_yaml(scenario));
}

// As after --set of the key that a twin follows.
TEST(Variation, SameHasTheValueOfAKeyThatIsNotDrawn) {
  const std::string twin =
      "  twin: {label: 1, mesh: b.glb, layout: {line: {count: 5, spacing_m: "
      "same(targets.array.layout.line.spacing_m)}}}\n";
  const Scenario scenario = parse(replaced(kDrawn, "dataset:", twin + "dataset:"));
  EXPECT_EQ(scenario.targets[2].layout->line->spacing_m, 20);
  EXPECT_EQ(drawn(scenario, 3).targets[2].layout->line->spacing_m, 20);
  EXPECT_EQ(scenario.variations.size(), parse(kDrawn).variations.size());
  EXPECT_THAT(effective_yaml(scenario), Not(HasSubstr("same(")));
}

TEST(Variation, SameNamesAnotherDrawnKey) {
  const auto complaint = [](const std::string& key) {
    return complaint_about(replaced(kDrawn, "spacing_m: 20", "spacing_m: same(" + key + ")"));
  };
  for (const char* key : {"targets.array.layout.line.spacing_m", "sea.gamma", "clutter.scr_db", ""}) {
    EXPECT_THAT(complaint(key), AllOf(HasSubstr("file.yaml:10:"), HasSubstr("targets.array.layout.line.spacing_m"),
                                      HasSubstr("must name another key that is written here")))
        << key;
  }
}

// The effective scenario of a drawn spectrum has the keys of all of its choices; other keys that do not apply are
// refused as ever.
TEST(Variation, OfAChoiceAllowsTheKeysOfItsOtherValues) {
  const std::string text =
      "seaglint: 1\nsea: {spectrum: \"choice(bretschneider, jonswap)\", gamma: 2}\n"
      "targets: {dot: {label: 0, points: [{position_m: [0, 0, 0]}]}}\n"
      "dataset: {maps_per_case: 1, realisations_per_case: 1}\n";
  const Scenario scenario = parse_scenario(text, "spectrum.yaml");
  EXPECT_EQ(effective_yaml(parse_scenario(effective_yaml(scenario), "effective.yaml")), effective_yaml(scenario));
  EXPECT_THROW(parse_scenario(text, "spectrum.yaml", {{"sea.spectrum", "bretschneider"}}), InputError);
}

// A section is written where a key of it is drawn, though the middle of the distribution is the default.
TEST(Variation, OfAKeyWhoseMiddleIsTheDefaultIsInTheEffectiveScenario) {
  const Scenario scenario = parse_scenario(
      "seaglint: 1\ntargets: {hull: {label: 0, mesh: hull.obj, orientation: {forward: \"choice(+x, -x)\"}}}\n"
      "dataset: {maps_per_case: 1, realisations_per_case: 1}\n",
      "turned.yaml");
  const Scenario again = parse_scenario(effective_yaml(scenario), "effective.yaml");
  ASSERT_EQ(again.variations.size(), 1u);
  EXPECT_EQ(again.variations.front().key_path, "targets.hull.orientation.forward");
}

// Seas as they occur: wave height and period by steepness, and pairs of a scatter diagram.

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
  EXPECT_HAS(yaml, "  steepness: [0.02, 0.05]\n");
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
  for (const auto& [sea, message] : cases) EXPECT_HAS(complaint_about(kShort + sea), message) << sea;
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
    return refusal_of([&] { read(sea, more); });
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
  EXPECT_HAS(refusal("scatter_diagram: seas.csv"), "sea.scatter_diagram: value 'seas.csv': all of its seas break");
}

TEST_F(DrawnPairs, AreWrittenAsTheirFile) {
  const Scenario scenario = read("scatter_diagram: seas.csv, gamma: uniform(1 5)");
  const std::string yaml = effective_yaml(scenario);
  EXPECT_HAS(yaml, "  scatter_diagram: seas.csv\n");
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
    EXPECT_HAS(message, "not allowed here: sea.scatter_diagram gives wave heights and periods") << other;
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
  }
  EXPECT_HAS(refusal("scatter_diagram: sees.csv"), "did you mean 'seas.csv'?");
  EXPECT_HAS(refusal("scatter_diagram: choice(seas.csv other.csv)"), "must be one value for all maps");
  EXPECT_HAS(refusal("scatter_diagram: [seas.csv]"), "sea.scatter_diagram: a list: must be a text");
  EXPECT_HAS(refusal("scatter_diagram: seas.csv, spectrum: table, table: seas.csv"), "seas.csv");
  // What some of its pairs contradict is named with one.
  EXPECT_HAS(refusal("scatter_diagram: seas.csv, cutoff_rad_s: 1.4"),
             "where sea.scatter_diagram has waves of 1 m with peak_period_s 4");
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Drawn values: their distributions against closed moments, where they are drawn, what they depend on, how they are
// written and refused.
#include "sim/scenario/draws/variation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "sim/core/process/error.h"
#include "sim/core/text/words.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

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
  for (const auto& [text, reason] : wrong) {
    try {
      parse_distribution(text);
      ADD_FAILURE() << text << " was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(reason)) << text;
    }
  }
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
        Override{"targets.ship.label", "choice(0, 1)"}}) {
    EXPECT_THAT(complaint_about(kDrawn, {set}), HasSubstr("must be one value for all maps")) << set.key_path;
  }
}

TEST(Variation, WithinAListIsRefused) {
  EXPECT_THAT(complaint_about(kDrawn, {Override{"view.elevation_deg", "[1, 'uniform(2, 3)']"}}),
              HasSubstr("view.elevation_deg.1: value 'uniform(2, 3)': a distribution cannot be one of a list"));
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
  EXPECT_THAT(effective_yaml(scenario), HasSubstr("count: same(targets.array.layout.line.count)\n"));
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

}  // namespace
}  // namespace seaglint

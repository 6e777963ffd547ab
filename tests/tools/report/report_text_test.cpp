// SPDX-License-Identifier: BSD-3-Clause
// Report texts on the probes, on the absolute level among them, and on the numbers of predictions and seas behind its
// figures.
#include "tools/report/report_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tools/report/report_figures.h"

namespace seaglint {
namespace {

using nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::Not;

// Scores of 300 rows: this many of the ships and of the arrays are classified correctly.
ordered_json scores(double ships, double ships_right, double arrays_right) {
  const double arrays = 300 - ships;
  return {{"rows", 300},
          {"accuracy", (ships_right + arrays_right) / 300},
          {"accuracy_95", {nullptr, nullptr}},
          {"confusion",
           {{"array_as_array", arrays_right},
            {"array_as_ship", arrays - arrays_right},
            {"ship_as_array", ships - ships_right},
            {"ship_as_ship", ships_right}}}};
}

std::string table_of(const ordered_json& scores) {
  return probes_table(
      {{"split_repeats", 1},
       {"learning", {{"split.by", "sea"}}},
       {"probes",
        {{{"name", "hop code"}, {"kind", "blind"}, {"meaning", "-"}, {"random", scores}, {"group", scores}}}}},
      {});
}

TEST(ProbesTable, TreatsClassProportionsAsChance) {
  // With equal numbers of ships and arrays half is chance, plus or minus 2.576 standard deviations, 7.4 points.
  EXPECT_THAT(table_of(scores(150, 80, 75)), HasSubstr("as chance"));
  EXPECT_THAT(table_of(scores(150, 90, 90)), HasSubstr("look for a leak"));
  EXPECT_THAT(table_of(scores(150, 60, 60)), HasSubstr("look for a leak"));
  // Two ships to an array: always predicting ship is correct in 66.7 %, guessing in proportion in 55.6 %.
  EXPECT_THAT(table_of(scores(200, 200, 0)), Not(HasSubstr("leak")));
  EXPECT_THAT(table_of(scores(200, 133, 33)), Not(HasSubstr("leak")));
  EXPECT_THAT(table_of(scores(200, 180, 50)), HasSubstr("look for a leak"));
  EXPECT_THAT(table_of(scores(200, 100, 20)), HasSubstr("look for a leak"));
}

// An accuracy below guessing on unseen maps: the probe does not separate the classes.
TEST(ProbesTable, CallsAccuraciesBelowGuessingChance) {
  ordered_json random = scores(150, 60, 73), group = scores(150, 75, 75);  // 44.3 and 50 %
  const auto table = [&](const char* kind) {
    return probes_table({{"split_repeats", 1},
                         {"learning", {{"split.by", "sea"}}},
                         {"probes",
                          {{{"name", "signal to clutter and noise"},
                            {"kind", kind},
                            {"meaning", "-"},
                            {"random", random},
                            {"group", group}}}}},
                        {});
  };
  random["accuracy_95"] = {0.384, 0.498};
  group["accuracy_95"] = {0.5, 0.5};
  for (const char* kind : {"ratio", "shape", "scale", "feature"}) EXPECT_THAT(table(kind), HasSubstr("chance: "));
  random["accuracy_95"] = {0.52, 0.6};
  for (const char* kind : {"ratio", "shape", "scale", "feature"}) EXPECT_THAT(table(kind), Not(HasSubstr("chance")));
}

// A probe of each kind that separates the classes.
ordered_json telling_probes() {
  ordered_json metrics{{"split_repeats", 1}, {"learning", {{"split.by", "sea"}}}, {"probes", ordered_json::array()}};
  const ordered_json right = scores(150, 145, 145);
  for (const auto& [name, kind] :
       {std::pair{"total power", "scale"}, {"signal to clutter and noise", "ratio"}, {"sigma_v alone", "feature"}})
    metrics["probes"].push_back(
        {{"name", name}, {"kind", kind}, {"meaning", "-"}, {"random", right}, {"group", right}});
  return metrics;
}

Scenario with_clutter(ClutterLevel level, NoiseLevel noise, bool enabled = true) {
  Scenario scenario;
  scenario.clutter.level = level;
  scenario.clutter.noise_level = noise;
  scenario.clutter.enabled = enabled;
  return scenario;
}

// Where clutter or noise have their own level, the ratio of the target to them determines which centres are found.
TEST(AbsoluteLevel, AffectsFeaturesWhereClutterOrNoiseIsIndependentOfTheTarget) {
  const ordered_json metrics = telling_probes();
  for (const Scenario& scenario :
       {with_clutter(ClutterLevel::kScr, NoiseLevel::kCnr), with_clutter(ClutterLevel::kScr, NoiseLevel::kSnr),
        with_clutter(ClutterLevel::kNrl, NoiseLevel::kSnr, false)}) {
    EXPECT_THAT(note_of_level(metrics, scenario),
                HasSubstr("Total power alone reaches 96.7 % on unseen seas. No feature group sees it"));
    EXPECT_THAT(probes_table(metrics, scenario), HasSubstr("no feature uses it"));
    EXPECT_THAT(probes_table(metrics, scenario), Not(HasSubstr("level has a part")));
  }
  const std::pair<Scenario, const char*> cases[] = {
      {with_clutter(ClutterLevel::kNrl, NoiseLevel::kCnr), "The clutter is not scaled"},
      {with_clutter(ClutterLevel::kNrl, NoiseLevel::kThermal), "Clutter and receiver noise are not scaled"},
      {with_clutter(ClutterLevel::kScr, NoiseLevel::kThermal), "The receiver’s noise is not scaled"},
      {with_clutter(ClutterLevel::kNrl, NoiseLevel::kThermal, false), "The receiver’s noise is not scaled"}};
  for (const auto& [scenario, words] : cases) {
    const std::string note = note_of_level(metrics, scenario), table = probes_table(metrics, scenario);
    EXPECT_THAT(note, HasSubstr("Features see the level.</b> " + std::string(words)));
    EXPECT_THAT(note, HasSubstr("the ratio of the target to clutter and noise 96.7 %"));
    EXPECT_THAT(note, Not(HasSubstr("No feature group sees it")));
    EXPECT_THAT(table, HasSubstr("features see it by what is found"));
    EXPECT_THAT(table, HasSubstr("it decides what is found"));
    EXPECT_THAT(table, HasSubstr("level has a part in what is found"));
    EXPECT_THAT(table, Not(HasSubstr("no feature uses it")));
  }
}

// 36 predictions of three splits are not 36 of a data set's 40 maps, 28 of which are each split's training rows.
TEST(AccuracyTables, LabelPredictionsOfPooledSplits) {
  ordered_json evaluation = scores(150, 140, 140);
  evaluation.update({{"rows", 36},
                     {"groups", 8},
                     {"auc", 0.9},
                     {"log_loss", 0.2},
                     {"train_rows", 28},
                     {"by_wave_height", ordered_json::array()}});
  const ordered_json both{{"random", evaluation}, {"group", evaluation}};
  ordered_json metrics{{"split_repeats", 3}, {"learning", {{"split.by", "sea"}}}};
  for (const char* group : {"handmade", "cnn", "fused"}) {
    metrics[group] = both;
    metrics[group].update({{"fusion", "split"}, {"fewer_rows", both}, {"in_sample", both}});
  }
  const std::string pooled = accuracy_tables(metrics, {"reflectors", "line"});
  EXPECT_THAT(pooled, Not(HasSubstr("test maps")));
  EXPECT_THAT(pooled, HasSubstr("test predictions"));
  EXPECT_THAT(pooled, HasSubstr("predictions: reflectors as line"));
  EXPECT_THAT(
      pooled,
      HasSubstr("3 splits under each protocol, pooled: a map that several of them test has a prediction of each"));
  EXPECT_THAT(note_of_seas(metrics),
              HasSubstr("3 splits by sea, pooled, test on 8 sea realisations in all, each on a part of them."));
  metrics["split_repeats"] = 1;
  EXPECT_THAT(accuracy_tables(metrics, {"reflectors", "line"}), HasSubstr("a test prediction is a map"));
  EXPECT_THAT(note_of_seas(metrics), HasSubstr("The split by sea tests on 8 sea realisations."));
}

// "Unseen seas" only where whole seas are on one side.
TEST(DivisionWords, FollowTheColumnAndWhatIsHeldOut) {
  ordered_json metrics = telling_probes();
  EXPECT_EQ(division_words(metrics).unseen, "unseen seas");
  metrics["learning"]["split.by"] = "azimuth_deg";
  metrics["division"] = "split by azimuth_deg";
  const DivisionWords words = division_words(metrics);
  EXPECT_FALSE(words.by_sea);
  EXPECT_EQ(words.by, "by azimuth_deg");
  const Scenario scenario = with_clutter(ClutterLevel::kScr, NoiseLevel::kCnr);
  const std::string note = note_of_level(metrics, scenario), table = probes_table(metrics, scenario);
  EXPECT_THAT(note, HasSubstr("reaches 96.7 % on values of azimuth_deg that were not trained on."));
  EXPECT_THAT(table, HasSubstr("split by azimuth_deg"));
  for (const std::string& text : {note, table}) {
    EXPECT_THAT(text, Not(HasSubstr("unseen")));
    EXPECT_THAT(text, Not(HasSubstr("by sea")));
  }
  metrics["learning"]["split.by"] = "sea";
  metrics["division"] = "tested on layout=ring only; split by sea realisation (no test sea was seen in training)";
  EXPECT_EQ(division_words(metrics).unseen, "held-out maps (layout=ring) of unseen seas");
  EXPECT_EQ(division_words(metrics).heading,
            "Split by sea realisation (no test sea was seen in training), tested on layout=ring only");
}

TEST(ClassNames, AreThoseOfTheTargets) {
  Scenario scenario;
  for (const auto& [name, label] : {std::pair{"frigate", 1}, {"corner", 0}, {"boat", 1}}) {
    scenario.targets.emplace_back();
    scenario.targets.back().name = name;
    scenario.targets.back().label = label;
  }
  EXPECT_EQ(class_names(scenario), (ClassNames{"corner", "frigate, boat"}));
  scenario.targets.resize(5, scenario.targets.back());
  EXPECT_EQ(class_names(scenario)[1], "label 1");
}

TEST(RocPlot, ShowsEveryGroupWithItsAreaBesideChance) {
  ordered_json scores{{"auc", 0.75}, {"roc", {{"false_alarms", {0, 0.5, 1}}, {"detections", {0, 1, 1}}}}};
  ordered_json metrics;
  metrics["learning"]["split.by"] = "sea";
  for (const char* group : {"handmade", "cnn", "fused"}) metrics[group]["group"] = scores;
  const LinePlot plot = roc_plot(metrics, "group");
  ASSERT_EQ(plot.series.size(), 4u);
  EXPECT_EQ(plot.series[2].name, "fused, AUC 0.750");
  EXPECT_EQ(plot.series[2].x, (std::vector<double>{0, 50, 100}));
  EXPECT_EQ(plot.series[2].y, (std::vector<double>{0, 100, 100}));
  EXPECT_EQ(plot.series[3].name, "chance");
}

}  // namespace
}  // namespace seaglint

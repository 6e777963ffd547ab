// SPDX-License-Identifier: BSD-3-Clause
// Texts of a report: probes, absolute level, numbers of predictions and seas behind its figures, the paper's claims,
// and benchmarks in its folders.
#include "tools/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/temporary_folder.h"
#include "tests/tools/study_with_scores.h"
#include "tools/page/html.h"

namespace seaglint {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Scores of 300 rows: this many of the ships and of the arrays are classified correctly.
Scores scores_of_300(std::size_t ships, std::size_t ships_right, std::size_t arrays_right) {
  Scores scores;
  scores.rows = 300;
  scores.groups = 10;
  scores.accuracy = static_cast<double>(ships_right + arrays_right) / 300;
  scores.accuracy_95 = {std::nan(""), std::nan("")};
  scores.confusion = {{arrays_right, 300 - ships - arrays_right}, {ships - ships_right, ships_right}};
  return scores;
}

Study with_probe(const char* name, ProbeKind kind, const Scores& random, const Scores& group) {
  Study study = study_of({0.9}, {0.9}, {0.9}, {0.9});
  study.probes = {{name, kind, "-", {{random, {}, 0}, {group, {}, 0}}}};
  return study;
}

std::string table_of(const Scores& scores) {
  return probes_table(with_probe("hop code", ProbeKind::kBlind, scores, scores), {});
}

TEST(ProbesTable, TreatsClassProportionsAsChance) {
  // With equal numbers of ships and arrays half is chance, plus or minus 2.576 standard deviations, 7.4 points.
  EXPECT_THAT(table_of(scores_of_300(150, 80, 75)), HasSubstr("as chance"));
  EXPECT_THAT(table_of(scores_of_300(150, 90, 90)), HasSubstr("look for a leak"));
  EXPECT_THAT(table_of(scores_of_300(150, 60, 60)), HasSubstr("look for a leak"));
  // Two ships to an array: always predicting ship is correct in 66.7 %, guessing in proportion in 55.6 %.
  EXPECT_THAT(table_of(scores_of_300(200, 200, 0)), Not(HasSubstr("leak")));
  EXPECT_THAT(table_of(scores_of_300(200, 133, 33)), Not(HasSubstr("leak")));
  EXPECT_THAT(table_of(scores_of_300(200, 180, 50)), HasSubstr("look for a leak"));
  EXPECT_THAT(table_of(scores_of_300(200, 100, 20)), HasSubstr("look for a leak"));
}

// An accuracy below guessing on unseen maps: the probe does not separate the classes.
TEST(ProbesTable, CallsAccuraciesBelowGuessingChance) {
  Scores random = scores_of_300(150, 60, 73), group = scores_of_300(150, 75, 75);  // 44.3 and 50 %
  constexpr ProbeKind kKinds[] = {ProbeKind::kRatio, ProbeKind::kShape, ProbeKind::kScale, ProbeKind::kFeature};
  const auto table = [&](ProbeKind kind) { return probes_table(with_probe("a", kind, random, group), {}); };
  random.accuracy_95 = {0.384, 0.498};
  group.accuracy_95 = {0.5, 0.5};
  for (const ProbeKind kind : kKinds) EXPECT_THAT(table(kind), HasSubstr("chance: "));
  random.accuracy_95 = {0.52, 0.6};
  for (const ProbeKind kind : kKinds) EXPECT_THAT(table(kind), Not(HasSubstr("chance")));
}

// A probe of each kind that separates the classes.
Study telling_probes() {
  Study study = study_of({0.9}, {0.9}, {0.9}, {0.9});
  const Evaluation right{scores_of_300(150, 145, 145), {}, 0};
  study.probes = {{"total power", ProbeKind::kScale, "-", {right, right}},
                  {"signal to clutter and noise", ProbeKind::kRatio, "-", {right, right}},
                  {"sigma_v alone", ProbeKind::kFeature, "-", {right, right}}};
  return study;
}

std::string page_of(const Study& study, const Scenario& scenario) {
  RunResults results{{}, {study, {}, {}, "1", {}, ""}};
  results.data.axes = {{0, 1}, {0, 1}};
  return report_body(results, scenario, {});
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
  const Study study = telling_probes();
  for (const Scenario& scenario :
       {with_clutter(ClutterLevel::kScr, NoiseLevel::kCnr), with_clutter(ClutterLevel::kScr, NoiseLevel::kSnr),
        with_clutter(ClutterLevel::kNrl, NoiseLevel::kSnr, false)}) {
    const std::string page = page_of(study, scenario);
    EXPECT_THAT(page, HasSubstr("Total power alone reaches 96.7 % on unseen seas. No feature group sees it"));
    EXPECT_THAT(page, HasSubstr("no feature uses it"));
    EXPECT_THAT(page, Not(HasSubstr("level has a part")));
  }
  const std::pair<Scenario, const char*> cases[] = {
      {with_clutter(ClutterLevel::kNrl, NoiseLevel::kCnr), "The clutter is not scaled"},
      {with_clutter(ClutterLevel::kNrl, NoiseLevel::kThermal), "Clutter and receiver noise are not scaled"},
      {with_clutter(ClutterLevel::kScr, NoiseLevel::kThermal), "The receiver’s noise is not scaled"},
      {with_clutter(ClutterLevel::kNrl, NoiseLevel::kThermal, false), "The receiver’s noise is not scaled"}};
  for (const auto& [scenario, words] : cases) {
    const std::string page = page_of(study, scenario);
    for (const std::string& text :
         {"Features see the level.</b> " + std::string(words), std::string("clutter and noise 96.7 %"),
          std::string("features see it by what is found"), std::string("it decides what is found"),
          std::string("level has a part in what is found")})
      EXPECT_THAT(page, HasSubstr(text));
    EXPECT_THAT(page, Not(HasSubstr("No feature group sees it")));
    EXPECT_THAT(page, Not(HasSubstr("no feature uses it")));
  }
}

// Predictions of several splits are not maps of the data set.
TEST(AccuracyTables, LabelPredictionsOfPooledSplits) {
  const Study study = study_of({0.9, 0.95}, {0.9, 0.95}, {0.9, 0.95}, {0.9, 0.95});
  Scenario scenario;
  scenario.targets.resize(2);
  scenario.targets[0].name = "line";
  scenario.targets[0].label = 1;
  scenario.targets[1].name = "reflectors";
  scenario.learning.split_repeats = 3;
  const std::string pooled = page_of(study, scenario);
  EXPECT_THAT(pooled, Not(HasSubstr("test maps")));
  EXPECT_THAT(pooled, HasSubstr("<th scope=\"col\">test predictions</th>"));
  EXPECT_THAT(pooled, HasSubstr("predictions: reflectors as line"));
  EXPECT_THAT(pooled, HasSubstr("3 splits under each protocol, pooled: a map that several of them test has a"));
  EXPECT_THAT(pooled,
              HasSubstr("3 splits by sea, pooled, test on 50 sea realisations in all, each on a part of them."));
  EXPECT_THAT(pooled, HasSubstr("<td>0.1</td><td>90.0 % <small>(88–92)</small></td>"));
  scenario.learning.split_repeats = 1;
  const std::string one = page_of(study, scenario);
  EXPECT_THAT(one, HasSubstr("a test prediction is a map"));
  EXPECT_THAT(one, HasSubstr("The split by sea tests on 50 sea realisations."));
}

// "Unseen seas" only where whole seas are on one side.
TEST(DivisionWords, FollowTheColumnAndWhatIsHeldOut) {
  EXPECT_EQ(division_words({}, "").unseen, "unseen seas");
  Scenario scenario = with_clutter(ClutterLevel::kScr, NoiseLevel::kCnr);
  scenario.learning.split.by = "azimuth_deg";
  const DivisionWords words = division_words(scenario.learning.split, "split by azimuth_deg");
  EXPECT_FALSE(words.by_sea);
  EXPECT_EQ(words.by, "by azimuth_deg");
  EXPECT_THAT(page_of(telling_probes(), scenario),
              HasSubstr("reaches 96.7 % on values of azimuth_deg that were not trained on."));
  const std::string table = probes_table(telling_probes(), scenario);
  EXPECT_THAT(table, HasSubstr("split by azimuth_deg"));
  EXPECT_THAT(table, Not(HasSubstr("by sea")));
  const DivisionWords ring =
      division_words({}, "tested on layout=ring only; split by sea realisation (no test sea was seen in training)");
  EXPECT_EQ(ring.unseen, "held-out maps (layout=ring) of unseen seas");
  EXPECT_EQ(ring.heading, "Split by sea realisation (no test sea was seen in training), tested on layout=ring only");
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
  Study study = study_of({0.9}, {0.9}, {0.9}, {0.9});
  for (FeatureGroupResult& group : study.groups) {
    group.outcomes[1].primary.scores.auc = 0.75;
    group.outcomes[1].roc = {{{0, 0}, {0.5, 1}, {1, 1}}};
  }
  const LinePlot plot = roc_plot(study, {}, Protocol::kGroup);
  ASSERT_EQ(plot.series.size(), 4u);
  EXPECT_EQ(plot.series[2].name, "fused, AUC 0.750");
  EXPECT_EQ(plot.series[2].x, (std::vector<double>{0.1, 50, 100}));
  EXPECT_EQ(plot.series[2].y, (std::vector<double>{0, 100, 100}));
  EXPECT_EQ(plot.series[3].name, "chance");
}

// One judge: the page of a study and its benchmark.json state the same claims with the same verdicts, word for word;
// and so does the page of another run that shows this benchmark.
TEST(PapersClaims, HaveOneVerdictOnThePageAndInTheBenchmarksFile) {
  const TemporaryFolder folder;
  for (const double fused : {0.8, 0.93, 0.99}) {
    const Study study = study_of({0.9, 0.93}, {0.9, 0.93}, {fused, fused}, {0.92, 0.92}, fused - 0.35);
    Scenario scenario;
    EXPECT_THAT(page_of(study, scenario), Not(HasSubstr("id=\"paper\"")));
    scenario.report.claims = ReportClaims::kPaper;
    const std::string page = page_of(study, scenario), text = benchmark_json({"a<b", true, 1, 120, 30, 2}, study);
    const std::filesystem::path file = folder.path() / kBenchmarkFile;
    write_file(file, text);
    const std::string section = benchmark_section(read_benchmark_file(file));
    const auto json = nlohmann::json::parse(text);
    ASSERT_EQ(json.at("claims").size(), claims_of(study).size());
    for (const auto& claim : json.at("claims")) {
      const auto cell = [&](const char* member) {
        return "<td>" + escape_html(claim.at(member).get<std::string>()) + "</td>";
      };
      EXPECT_THAT(page, HasSubstr(cell("why") + cell("verdict") + cell("meaning")));
      EXPECT_THAT(page, HasSubstr("<tr>" + cell("claim")));
      EXPECT_THAT(section, HasSubstr(cell("claim") + cell("verdict") + cell("why") + cell("meaning")));
    }
  }
}

TEST(BenchmarkSection, HasTheFiguresOfItsFile) {
  const TemporaryFolder folder;
  Study study = study_of({0.93, 0.25}, {0.9, 0.9}, {0.9, 0.9}, {0.9, 0.9}, 0.75);
  study.division = "split by sea";
  write_file(folder.path() / kBenchmarkFile, benchmark_json({"a<b", true, 1, 120, 30, 2}, study));
  StoredBenchmark benchmark = read_benchmark_file(folder.path() / kBenchmarkFile);
  benchmark.folder = "twin";
  const std::string html = benchmark_section(benchmark);
  EXPECT_THAT(html, HasSubstr("Benchmark <b>a&lt;b</b> at its small size"));
  EXPECT_THAT(html, HasSubstr("120 maps in 30 seas; split by sea."));
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\">Hs 0.1 m</th><th scope=\"col\">Hs 1 m</th>"));
  EXPECT_THAT(html, HasSubstr("<td>handmade</td><td>59.0 (57–61)</td><td>93.0</td><td>25.0</td>"));
  EXPECT_THAT(html, HasSubstr("<td>sample order *</td><td>75.0 (73–77)</td>"));
  EXPECT_THAT(html, HasSubstr("<td>sigma_r alone</td><td>50.0 (48–52)</td>"));
  EXPECT_THAT(html, HasSubstr("<a href=\"twin/report.html\">"));
  benchmark.folder = "a b";
  EXPECT_THAT(benchmark_section(benchmark), Not(HasSubstr("<a ")));
}

TEST(BenchmarkSection, OfADamagedFileIsAnErrorOfTheInput) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / kBenchmarkFile;
  const auto whole =
      nlohmann::ordered_json::parse(benchmark_json({"a", true, 1, 120, 30, 2}, study_of({0.9}, {0.9}, {0.9}, {0.9})));
  for (const char* member : {"benchmark", "small", "maps", "seas", "division", "baselines", "floor", "claims"}) {
    nlohmann::ordered_json damaged = whole;
    damaged.erase(member);
    write_file(file, damaged.dump());
    EXPECT_THROW(read_benchmark_file(file), InputError) << member;
  }
}

}  // namespace
}  // namespace seaglint

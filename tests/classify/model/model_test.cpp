// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "classify/model/classifiers.h"
#include "classify/model/division.h"
#include "classify/model/learning_table.h"
#include "classify/model/saved_model.h"
#include "classify/model/scores.h"
#include "classify/model/study.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using ::testing::ElementsAre;
using Values = std::vector<double>;

// 3 sea states, 5 seas of each, 20 maps of each sea.
std::vector<RowGroup> fifteen_seas() {
  std::vector<RowGroup> rows;
  for (int group = 0; group < 15; ++group) rows.insert(rows.end(), 20, {group, group / 5});
  return rows;
}

TEST(Split, ByGroupKeepsEverySeaInOnePart) {
  const auto rows = fifteen_seas();
  for (std::uint64_t repeat = 0; repeat < 20; ++repeat) {
    const Split split = split_rows(rows, Protocol::kGroup, 0.7, 42, repeat);
    std::set<std::int64_t> train, test;
    for (const std::size_t row : split.train) train.insert(rows[row].group);
    for (const std::size_t row : split.test) test.insert(rows[row].group);
    for (const std::int64_t group : test) EXPECT_FALSE(train.contains(group));
    EXPECT_EQ(split.train.size() + split.test.size(), rows.size());
    // 10.5 groups of 15, with every sea state in both parts.
    EXPECT_NEAR(static_cast<double>(train.size()), 10.5, 0.5);
    std::set<std::int64_t> states;
    for (const std::int64_t group : test) states.insert(group / 5);
    EXPECT_EQ(states.size(), 3u);
  }
}

// One sea of each of four states: 2.8 are training groups.
TEST(Split, ByGroupTestsOnEveryStateInSomeRepeat) {
  std::vector<RowGroup> rows;
  for (int group = 0; group < 4; ++group) rows.insert(rows.end(), 20, {group, group});
  std::map<std::int64_t, int> repeats_of_state;
  for (std::uint64_t repeat = 0; repeat < 400; ++repeat) {
    const Split split = split_rows(rows, Protocol::kGroup, 0.7, 42, repeat);
    ASSERT_EQ(split.test.size(), 20u) << "repeat " << repeat;
    ++repeats_of_state[rows[split.test.front()].sea_state];
  }
  // A quarter of 400 each; four standard deviations of the binomial count are 4 sqrt(400 / 4 * 3 / 4) = 35.
  for (int state = 0; state < 4; ++state) EXPECT_NEAR(repeats_of_state[state], 100, 35) << "state " << state;
}

// Ten seas of each of three states: 7 of each are training groups, without remainders, so that the states are split
// independently.
TEST(Split, ByGroupOfWholeFractionsIsThatOfEachState) {
  std::vector<RowGroup> rows;
  for (int group = 0; group < 30; ++group) rows.push_back({group, group / 10});
  for (std::uint64_t repeat = 0; repeat < 20; ++repeat) {
    std::vector<std::size_t> alone;
    for (std::size_t state = 0; state < 3; ++state) {
      const std::span<const RowGroup> of_state(rows.data() + 10 * state, 10);
      for (const std::size_t row : split_rows(of_state, Protocol::kGroup, 0.7, 42, repeat).test)
        alone.push_back(10 * state + row);
    }
    EXPECT_EQ(alone.size(), 9u);
    EXPECT_EQ(split_rows(rows, Protocol::kGroup, 0.7, 42, repeat).test, alone);
  }
}

TEST(Split, ByRowsHasTheFractionAndDividesSeas) {
  const auto rows = fifteen_seas();
  const Split split = split_rows(rows, Protocol::kRandom, 0.7, 42, 0);
  EXPECT_EQ(split.train.size(), 210u);
  EXPECT_EQ(split.test.size(), 90u);
  std::set<std::int64_t> train, shared;
  for (const std::size_t row : split.train) train.insert(rows[row].group);
  for (const std::size_t row : split.test)
    if (train.contains(rows[row].group)) shared.insert(rows[row].group);
  EXPECT_EQ(shared.size(), 15u);
}

TEST(Split, DependsOnSeedAndRepeatOnly) {
  const auto rows = fifteen_seas();
  for (const Protocol protocol : {Protocol::kRandom, Protocol::kGroup}) {
    EXPECT_EQ(split_rows(rows, protocol, 0.7, 42, 0).test, split_rows(rows, protocol, 0.7, 42, 0).test);
    EXPECT_NE(split_rows(rows, protocol, 0.7, 42, 0).test, split_rows(rows, protocol, 0.7, 43, 0).test);
    EXPECT_NE(split_rows(rows, protocol, 0.7, 42, 0).test, split_rows(rows, protocol, 0.7, 42, 1).test);
  }
}

TEST(Split, ForFusionDividesTheTrainingRowsOnly) {
  const auto rows = fifteen_seas();
  for (const Protocol protocol : {Protocol::kRandom, Protocol::kGroup}) {
    const Split split = split_rows(rows, protocol, 0.7, 42, 0);
    const Split fusion = split_for_fusion(rows, split, protocol, 0.6, 42, 0);
    std::set<std::size_t> all(fusion.train.begin(), fusion.train.end());
    all.insert(fusion.test.begin(), fusion.test.end());
    EXPECT_EQ(std::vector<std::size_t>(all.begin(), all.end()), split.train);
    EXPECT_EQ(fusion.train.size() + fusion.test.size(), split.train.size());
  }
}

std::vector<Prediction> predictions_of(std::initializer_list<std::pair<int, double>> rows) {
  std::vector<Prediction> predictions;
  for (const auto& [label, probability] : rows) {
    const std::int64_t number = static_cast<std::int64_t>(predictions.size());
    predictions.push_back({static_cast<std::size_t>(number), number, label, probability});
  }
  return predictions;
}

TEST(Scores, AreThoseOfASmallExampleByHand) {
  const auto predictions = predictions_of({{1, 0.9}, {1, 0.4}, {0, 0.4}, {0, 0.1}, {0, 0.7}});
  const Scores scores = score(predictions, 100, 1, 0);
  EXPECT_DOUBLE_EQ(scores.accuracy, 3.0 / 5);
  // Correctly ranked pairs (ship, array): 0.9 ranks above all three; 0.4 ties with 0.4, ranks above 0.1 and below 0.7:
  // (3 + 1.5) / 6.
  EXPECT_DOUBLE_EQ(scores.auc, 4.5 / 6);
  EXPECT_NEAR(scores.log_loss, -(std::log(0.9) + std::log(0.4) + std::log(0.6) + std::log(0.9) + std::log(0.3)) / 5,
              1e-12);
  EXPECT_EQ(scores.confusion[1][1], 1u);
  EXPECT_EQ(scores.confusion[1][0], 1u);
  EXPECT_EQ(scores.confusion[0][0], 2u);
  EXPECT_EQ(scores.confusion[0][1], 1u);
}

// 40 drawn heights 0.05, 0.10, ... 2.00 m: eight bins of five, with the means 0.15, 0.40, ... m.
TEST(Scores, OfADrawnQuantityAreThoseOfEightBinsOfEqualCount) {
  std::vector<DataRow> rows(40);
  std::vector<Prediction> predictions;
  for (std::size_t i = 0; i < 40; ++i) {
    rows[i].record.significant_wave_height_m = 0.05 * static_cast<double>(i + 1);
    rows[i].record.realisation = static_cast<std::int64_t>(i);
    const int label = i % 2 == 0 ? 0 : 1;
    predictions.push_back({i, static_cast<std::int64_t>(i), label, i < 10 ? 0.5 : label == 1 ? 0.9 : 0.1});
  }
  const Condition heights = condition_of(rows, kWaveHeightColumn);
  const ConditionScores all = score_by(heights, predictions, 10, 1, 0);
  ASSERT_EQ(all.bins.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(all.bins[i].mean, 0.15 + 0.25 * static_cast<double>(i), 1e-12);
    EXPECT_EQ(all.bins[i].scores.rows, 5u);
    EXPECT_NEAR(all.bins[i].scores.accuracy,
                i == 0   ? 0.4
                : i == 1 ? 0.6
                         : 1,
                1e-12)
        << i;  // 2 and 3 of 5 are of label 1
  }
  EXPECT_EQ(all.bins[1].text, "0.3 to 0.5");
  // Bins are those of all maps: predictions of a few have the same ones, without the empty bins.
  const ConditionScores last = score_by(heights, std::span(predictions).last(7), 10, 1, 0);
  ASSERT_EQ(last.bins.size(), 2u);
  EXPECT_EQ(last.bins.back().text, all.bins.back().text);
}

// Twelve swept heights, each of which is the only one of its sea state.
TEST(Scores, OfASweptQuantityAreThoseOfItsValues) {
  std::vector<DataRow> rows(48);
  for (std::size_t i = 0; i < 48; ++i) {
    rows[i].record.sea_state = static_cast<std::int64_t>(i / 4);
    rows[i].record.significant_wave_height_m = 0.1 * static_cast<double>(i / 4 + 1);
  }
  const Condition heights = condition_of(rows, kWaveHeightColumn);
  ASSERT_EQ(heights.bins.size(), 12u);
  EXPECT_EQ(heights.bins[2].text, "0.3");
  EXPECT_EQ(heights.bins[2].rows.size(), 4u);
  // With one more value in a case the quantity is drawn.
  rows[0].record.significant_wave_height_m = 0.11;
  EXPECT_EQ(condition_of(rows, kWaveHeightColumn).bins.size(), 8u);
}

TEST(Roc, IsThatOfASmallExampleByHand) {
  const auto curve = roc_curve(predictions_of({{1, 0.9}, {1, 0.4}, {0, 0.4}, {0, 0.1}, {0, 0.7}, {1, 0.95}}));
  // Thresholds 0.95 and 0.9: ships alone, a straight line; 0.7: one array; 0.4: a ship and an array together; 0.1.
  const double expected[][2] = {{0, 0}, {0, 2.0 / 3}, {1.0 / 3, 2.0 / 3}, {2.0 / 3, 1}, {1, 1}};
  ASSERT_EQ(curve.size(), std::size(expected));
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_DOUBLE_EQ(curve[i].false_alarms, expected[i][0]) << i;
    EXPECT_DOUBLE_EQ(curve[i].detections, expected[i][1]) << i;
  }
  EXPECT_TRUE(roc_curve(predictions_of({{1, 0.9}, {1, 0.2}})).empty());
}

// Trapezoids below the curve against Mann and Whitney's statistic; a thinned curve leaves out less than a step of both
// axes, so that the area changes by at most the sum of its steps' products, 2 / (most - 1).
TEST(Roc, HasTheAreaOfMannAndWhitney) {
  std::vector<Prediction> predictions;
  Random random({42, Stream::kBootstrap, 0});
  for (std::int64_t i = 0; i < 5000; ++i) {
    const int label = i % 3 == 0 ? 1 : 0;
    predictions.push_back(
        {static_cast<std::size_t>(i), i, label, std::round(1000 * (0.3 * label + 0.7 * random.uniform())) / 1000});
  }
  const double auc = score(predictions, 1, 1, 0).auc;
  const auto area = [](const std::vector<RocPoint>& curve) {
    double sum = 0;
    for (std::size_t i = 1; i < curve.size(); ++i)
      sum += (curve[i].false_alarms - curve[i - 1].false_alarms) * (curve[i].detections + curve[i - 1].detections) / 2;
    return sum;
  };
  const auto whole = roc_curve(predictions, 10'000), thinned = roc_curve(predictions, 50);
  EXPECT_GT(whole.size(), 3 * thinned.size());
  EXPECT_NEAR(area(whole), auc, 1e-12);
  EXPECT_LE(thinned.size(), 100u);
  EXPECT_NEAR(area(thinned), auc, 2.0 / 49);
}

TEST(Scores, HaveNoIntervalFromOneSea) {
  auto predictions = predictions_of({{1, 0.9}, {0, 0.8}});
  for (Prediction& p : predictions) p.group = 3;
  EXPECT_TRUE(std::isnan(score(predictions, 100, 1, 0).accuracy_95.low));
}

TEST(Scores, BootstrapIntervalOfIndependentRowsIsTheBinomialOne) {
  std::vector<Prediction> predictions;
  for (int i = 0; i < 400; ++i) predictions.push_back({0, i, 1, i % 5 == 0 ? 0.1 : 0.9});
  const Scores scores = score(predictions, 4000, 1, 0);
  // Accuracy 0.8, standard error sqrt(0.8 0.2 / 400) = 0.02; the bootstrap's own error of a 2.5 % point at 4000 draws
  // is below 5 % of the half width, and one row is 0.0025.
  EXPECT_NEAR(scores.accuracy_95.low, 0.8 - 1.96 * 0.02, 0.005);
  EXPECT_NEAR(scores.accuracy_95.high, 0.8 + 1.96 * 0.02, 0.005);
}

TEST(Scores, BootstrapIntervalGrowsWhenRowsOfASeaAgree) {
  std::vector<Prediction> predictions;
  for (int i = 0; i < 400; ++i) predictions.push_back({0, i / 20, 1, (i / 20) % 5 == 0 ? 0.1 : 0.9});
  const Scores scores = score(predictions, 4000, 1, 0);
  // Twenty independent seas instead of 400 rows: the standard error is sqrt(0.8 0.2 / 20) = 0.089.
  EXPECT_GT(scores.accuracy_95.high - scores.accuracy_95.low, 0.25);
}

// Two columns of noise; the label is the sign of a third.
FeatureMatrix noise_and_signal(std::vector<int>& labels, int rows) {
  FeatureMatrix features{{"noise_1", "noise_2", "signal"}, {}};
  Random random({5, Stream::kTest, 0});
  labels.clear();
  for (int i = 0; i < rows; ++i) {
    const double signal = random.normal();
    for (const double value : {random.normal(), random.normal(), signal})
      features.values.push_back(static_cast<float>(value));
    labels.push_back(signal > 0 ? 1 : 0);
  }
  return features;
}

TEST(Booster, FindsTheInformativeColumn) {
  std::vector<int> labels;
  const FeatureMatrix features = noise_and_signal(labels, 400);
  const Booster booster = Booster::train(features, labels, LearningSpec{});
  const std::vector<double> probabilities = booster.predict(features);
  int right = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) right += (probabilities[i] >= 0.5) == (labels[i] == 1) ? 1 : 0;
  EXPECT_GT(right, 395);
  const std::vector<double> gains = booster.gains(3);
  EXPECT_GT(gains[2], 0.8);
  EXPECT_NEAR(gains[0] + gains[1] + gains[2], 1, 1e-6);
}

TEST(Booster, RepeatsBitForBitAndReloadsFromItsFile) {
  std::vector<int> labels;
  const FeatureMatrix features = noise_and_signal(labels, 200);
  const Booster first = Booster::train(features, labels, LearningSpec{});
  const Booster second = Booster::train(features, labels, LearningSpec{});
  EXPECT_EQ(first.predict(features), second.predict(features));

  const TemporaryFolder folder;
  const auto file = folder.path() / "booster.json";
  first.save(file);
  EXPECT_EQ(Booster::load(file).predict(features), first.predict(features));
  const std::string bytes = read_file(file);
  for (const std::string& broken :
       {std::string(), bytes.substr(0, bytes.size() / 2), std::string("{}"), std::string("text")}) {
    write_file(file, broken);
    EXPECT_THROW(Booster::load(file), InputError) << broken.size() << " bytes";
  }
}

TEST(Booster, StopsBetweenTwoTrees) {
  std::vector<int> labels;
  const FeatureMatrix features = noise_and_signal(labels, 50);
  const StopFlag stop = true;
  EXPECT_THROW(Booster::train(features, labels, LearningSpec{}, &stop), Interrupted);
}

TEST(Booster, HasOneProbabilityWithoutInformation) {
  FeatureMatrix features{{"constant"}, std::vector<float>(50, 1.0f)};
  std::vector<int> labels(50, 0);
  for (std::size_t i = 0; i < 25; ++i) labels[i] = 1;
  const Booster booster = Booster::train(features, labels, LearningSpec{});
  for (const double p : booster.predict(features)) EXPECT_NEAR(p, 0.5, 0.1);
  EXPECT_EQ(booster.gains(1)[0], 0);
}

// Levels outside of the target on maps of known levels.

StoredAxes axes() {
  StoredAxes axes;
  for (int r = -96; r < 96; ++r) axes.range_m.push_back(r);
  for (int v = 0; v < 64; ++v) axes.velocity_mps.push_back(0.3 * (v - 32));
  return axes;
}

// Power of a cell by range and velocity; two centres, at -20 and 10 m.
template <class Power>
Sample map_of(Power power) {
  Sample sample;
  const StoredAxes grid = axes();
  for (const double v : grid.velocity_mps)
    for (const double r : grid.range_m) sample.magnitude.push_back(static_cast<float>(std::sqrt(power(r, v))));
  sample.centre_list = {{-20, 0.5f, 3}, {10, 0, 2}};
  return sample;
}

TEST(BlankedMap, OfUniformPowerIsLevel) {
  for (const double level : blanked_levels_db(map_of([](double, double) { return 7.0; }), axes()))
    EXPECT_NEAR(level, 0, 1e-6);
}

// Any power within 6 m of the centres and between them, and any common factor outside.
TEST(BlankedMap, DoesNotDependOnTheTargetNorOnTheLevelOfTheRest) {
  const auto rest = [](double r, double v) { return 1 + 0.5 * std::sin(0.1 * r) * std::cos(v); };
  const auto plain = map_of(rest);
  const auto loud = map_of([&](double r, double v) { return r >= -26 && r <= 16 ? 1e6 * v * v : 100 * rest(r, v); });
  const std::vector<double> a = blanked_levels_db(plain, axes()), b = blanked_levels_db(loud, axes());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-5) << i;
}

// Ten times the power in the band of 10 to 25 m at the lowest eighth of velocities: 26 < r' < 41 m on both sides.
TEST(BlankedMap, HasTheLevelOfItsBands) {
  const auto sample = map_of([](double r, double v) {
    const double outside = std::max(-26 - r, r - 16);
    return outside >= 10 && outside < 25 && v < 0.3 * (8 - 32) - 0.01 ? 10.0 : 1.0;
  });
  const std::vector<double> levels = blanked_levels_db(sample, axes());
  ASSERT_EQ(levels.size(), 32u);
  EXPECT_EQ(std::ranges::max_element(levels) - levels.begin(), 8);
  for (std::size_t i = 0; i < levels.size(); ++i) EXPECT_NEAR(levels[8] - levels[i], i == 8 ? 0 : 10, 1e-4) << i;
}

TEST(BlankedMap, WithoutRangesOutsideIsZero) {
  Sample sample = map_of([](double, double) { return 1.0; });
  sample.centre_list = {{-95, 0, 1}, {95, 0, 1}};
  for (const double level : blanked_levels_db(sample, axes())) EXPECT_EQ(level, 0);
  const Sample dark = map_of([](double, double) { return 0.0; });
  for (const double level : blanked_levels_db(dark, axes())) EXPECT_EQ(level, 0);
}

// Scores, trees and tables of more than two classes, by hand and against those of two.

const std::vector<std::string> kClasses{"decoys", "ship", "guarded ship"};

Prediction row(int label, const Values& probabilities, std::int64_t number = 0) {
  return prediction_of(static_cast<std::size_t>(number), number, label, probabilities);
}

std::vector<Prediction> five_rows() {
  return {row(0, {0.6, 0.3, 0.1}, 0), row(0, {0.2, 0.7, 0.1}, 1), row(1, {0.25, 0.5, 0.25}, 2),
          row(2, {0.1, 0.2, 0.7}, 3), row(2, {0.1, 0.5, 0.4}, 4)};
}

TEST(ScoresOfClasses, AreThoseOfASmallExampleByHand) {
  const Scores scores = score(five_rows(), 100, 1, 0);
  EXPECT_DOUBLE_EQ(scores.accuracy, 3.0 / 5);
  EXPECT_THAT(scores.confusion, ElementsAre(ElementsAre(1, 1, 0), ElementsAre(0, 1, 0), ElementsAre(0, 1, 1)));
  EXPECT_NEAR(scores.log_loss, -(std::log(0.6) + std::log(0.2) + std::log(0.5) + std::log(0.7) + std::log(0.4)) / 5,
              1e-12);
  // Hand and Till's mean over pairs. Decoys and ship: over P(decoys) 0.6 above 0.25, 0.2 below: 1/2; over P(ship) 0.5
  // above 0.3, below 0.7: 1/2. Decoys and guarded ship: both separate: 1. Ship and guarded ship: over P(ship) 0.5 above
  // 0.2, equal to 0.5: 3/4; over P(guarded ship) 0.7 and 0.4 above 0.25: 1.
  EXPECT_NEAR(scores.auc, (0.5 + 1 + 0.875) / 3, 1e-12);
}

// Rows of two of three classes, whose third probability is 0: the same pair, area and decisions.
TEST(ScoresOfClasses, OfAClassWithoutRowsAreThoseOfTheOtherTwo) {
  std::vector<Prediction> two, three;
  for (std::int64_t i = 0; i < 200; ++i) {
    Random random({3, Stream::kTest, static_cast<std::uint64_t>(i)});
    const int label = static_cast<int>(random.below(2));
    const double p = std::round(20 * (0.3 * label + 0.7 * random.uniform())) / 20;
    two.push_back({static_cast<std::size_t>(i), i, label, p});
    three.push_back(row(label, {1 - p, p, 0}, i));
  }
  const Scores a = score(two, 200, 7, 0), b = score(three, 200, 7, 0);
  EXPECT_NEAR(a.auc, b.auc, 1e-12);
  EXPECT_NEAR(a.log_loss, b.log_loss, 1e-12);
  // p = 1/2 is label 1 of two classes and the first of more.
  std::erase_if(two, [](const Prediction& p) { return p.probability == 0.5; });
  std::erase_if(three, [](const Prediction& p) { return p.by_class[1] == 0.5; });
  EXPECT_EQ(score(two, 200, 7, 0).accuracy, score(three, 200, 7, 0).accuracy);
  EXPECT_EQ(score(two, 200, 7, 0).accuracy_95.low, score(three, 200, 7, 0).accuracy_95.low);
  EXPECT_TRUE(std::isnan(score(std::vector{row(1, {0, 1, 0})}, 10, 1, 0).auc));
}

TEST(RocOfClasses, IsOneOfEachAgainstTheRest) {
  const auto curves = roc_curves(five_rows());
  ASSERT_EQ(curves.size(), 3u);
  // P(guarded ship): 0.7 and 0.4 of its own rows above all others.
  ASSERT_EQ(curves[2].size(), 3u);
  EXPECT_EQ(curves[2][1].false_alarms, 0);
  EXPECT_EQ(curves[2][1].detections, 1);
  EXPECT_EQ(roc_curves(std::vector<Prediction>{{0, 0, 1, 0.9}, {1, 1, 0, 0.2}}).size(), 1u);
}

// Largest probabilities 0.6 right; 0.7 wrong and 0.7 right; 0.5 right and 0.5 wrong.
TEST(CalibrationOfClasses, IsThatOfTheLargestProbability) {
  const Calibration result = calibration(five_rows());
  EXPECT_EQ(result.bins[5].rows, 2u);
  EXPECT_DOUBLE_EQ(result.bins[5].fraction, 0.5);
  EXPECT_EQ(result.bins[6].rows, 1u);
  EXPECT_DOUBLE_EQ(result.bins[7].fraction, 0.5);
  EXPECT_NEAR(result.expected_error, (0 + 0.4 + 0.4) / 5, 1e-12);
}

TEST(StudyText, NamesClassesByOneWord) {
  const nlohmann::ordered_json json = to_object(score(five_rows(), 10, 1, 0), kClasses);
  EXPECT_EQ(json["confusion"].size(), 9u);
  EXPECT_EQ(json["confusion"]["guarded_ship_as_ship"], 1);
  EXPECT_THAT(probability_columns("fused", kClasses),
              ElementsAre("probability_fused_decoys", "probability_fused_ship", "probability_fused_guarded_ship"));
  EXPECT_THAT(probability_columns("fused", default_classes()), ElementsAre("probability_fused"));
}

// Three intervals of the second column; the first is noise.
FeatureMatrix three_intervals(std::vector<int>& labels, std::uint64_t rows) {
  FeatureMatrix features{{"noise", "signal"}, {}};
  for (std::uint64_t i = 0; i < rows; ++i) {
    Random random({9, Stream::kTest, i});
    const double signal = 3 * random.uniform();
    features.values.push_back(static_cast<float>(random.normal()));
    features.values.push_back(static_cast<float>(signal));
    labels.push_back(static_cast<int>(signal));
  }
  return features;
}

TEST(BoosterOfClasses, SeparatesThreeClassesAndReloads) {
  std::vector<int> labels;
  const FeatureMatrix features = three_intervals(labels, 300);
  const Booster booster = Booster::train(features, labels, LearningSpec{}, nullptr, 3);
  const Values p = booster.predict(features);
  ASSERT_EQ(p.size(), 900u);
  int right = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EXPECT_NEAR(p[3 * i] + p[3 * i + 1] + p[3 * i + 2], 1, 1e-6);
    right += decision_of(std::span(p).subspan(3 * i, 3)) == labels[i] ? 1 : 0;
  }
  EXPECT_GT(right, 295);
  EXPECT_GT(booster.gains(2)[1], 0.8);
  EXPECT_EQ(booster.classes(), 3u);
  EXPECT_EQ(Booster::train(features, labels, LearningSpec{}, nullptr, 3).predict(features), p);

  const TemporaryFolder folder;
  const auto file = folder.path() / "three.json";
  booster.save(file);
  EXPECT_EQ(Booster::load(file).predict(features), p);
  EXPECT_EQ(Booster::load(file).classes(), 3u);
  for (int& label : labels) label = std::min(label, 1);
  EXPECT_EQ(Booster::train(features, labels, LearningSpec{}).classes(), 2u);
}

TEST(LearningTable, OfThreeClassesNeedsMapsOfAll) {
  LearningTable table;
  table.classes = kClasses;
  table.labels = {0, 2, 0, 2};
  table.handmade = {{"mwr"}, {1, 2, 3, 4}};
  EXPECT_EQ(refusal_of([&] { require_learnable(table, "set"); }),
            "set: none of 4 maps is of class 1 (ship); learning needs all 3 classes");
  table.labels = {0, 1, 2, 2};
  EXPECT_NO_THROW(require_learnable(table, "set"));
}

TEST(ModelCard, ComparesClassesByNameAndOrder) {
  EXPECT_EQ(classes_difference(kClasses, kClasses), "");
  EXPECT_EQ(classes_difference(default_classes(), kClasses), "array, ship instead of decoys, ship, guarded ship");
  EXPECT_NE(classes_difference({"ship", "array"}, default_classes()), "");
}

}  // namespace
}  // namespace seaglint

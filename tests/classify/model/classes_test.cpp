// SPDX-License-Identifier: BSD-3-Clause
// Scores, trees and tables of more than two classes, by hand and against those of two.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "classify/model/classifiers.h"
#include "classify/model/learning_table.h"
#include "classify/model/saved_model.h"
#include "classify/model/scores.h"
#include "classify/model/study.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

using ::testing::ElementsAre;
using Values = std::vector<double>;

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

  const auto file = std::filesystem::temp_directory_path() / ("seaglint_three_" + std::to_string(::getpid()) + ".json");
  booster.save(file);
  EXPECT_EQ(Booster::load(file).predict(features), p);
  EXPECT_EQ(Booster::load(file).classes(), 3u);
  std::filesystem::remove(file);
  for (int& label : labels) label = std::min(label, 1);
  EXPECT_EQ(Booster::train(features, labels, LearningSpec{}).classes(), 2u);
}

TEST(LearningTable, OfThreeClassesNeedsMapsOfAll) {
  LearningTable table;
  table.classes = kClasses;
  table.labels = {0, 2, 0, 2};
  table.handmade = {{"mwr"}, {1, 2, 3, 4}};
  try {
    require_learnable(table, "set");
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "set: none of 4 maps is of class 1 (ship); learning needs all 3 classes");
  }
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

// SPDX-License-Identifier: BSD-3-Clause
// Logistic regression against closed forms and the conditions of its minimum.
#include "classify/model/logistic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/random.h"

namespace seaglint {
namespace {

// Two normal classes of equal deviation s and means +-m: the odds are exp(2 m x / s^2).
FeatureMatrix normal_classes(std::size_t rows, double mean, std::vector<int>& labels) {
  FeatureMatrix features{{"x", "noise", "constant"}, {}};
  for (std::size_t i = 0; i < rows; ++i) {
    Random random({5, Stream::kTest, i});
    const int label = static_cast<int>(random.below(2));
    labels.push_back(label);
    features.values.push_back(static_cast<float>((label == 1 ? mean : -mean) + random.normal()));
    features.values.push_back(static_cast<float>(random.normal()));
    features.values.push_back(3);
  }
  return features;
}

TEST(LogisticModel, HasTheOddsOfTwoNormalClasses) {
  std::vector<int> labels;
  const FeatureMatrix features = normal_classes(20000, 0.7, labels);
  const LogisticModel model = LogisticModel::train(features, labels);
  // x has the deviation sqrt(1 + m^2); the weight's standard error is about 2 / sqrt(n (1 + ...)) = 0.02.
  EXPECT_NEAR(model.weights()[0] / std::sqrt(1 + 0.49), 1.4, 0.08);
  EXPECT_NEAR(model.weights()[1], 0, 0.08);
  EXPECT_EQ(model.weights()[2], 0);
  EXPECT_NEAR(model.offset(), 0, 0.08);
}

// The gradient of the penalised likelihood: sum of (p - y) z = -w, sum of (p - y) = 0.
TEST(LogisticModel, IsAtTheMinimumOfItsPenalisedLikelihood) {
  std::vector<int> labels;
  const FeatureMatrix features = normal_classes(400, 1.5, labels);
  const LogisticModel model = LogisticModel::train(features, labels);
  const std::vector<double> p = model.predict(features);
  double mean = 0, squares = 0;
  for (std::size_t i = 0; i < 400; ++i) mean += features.row(i)[0] / 400.0;
  for (std::size_t i = 0; i < 400; ++i) squares += std::pow(features.row(i)[0] - mean, 2) / 400;
  double along = 0, sum = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    along += (p[i] - labels[i]) * (features.row(i)[0] - mean) / std::sqrt(squares);
    sum += p[i] - labels[i];
  }
  EXPECT_NEAR(along, -model.weights()[0], 1e-6);
  EXPECT_NEAR(sum, 0, 1e-6);
}

// Separable rows have no maximum of the likelihood; the penalty keeps the weight finite. Four rows at +-1: the
// derivative 4 / (1 + e^w) = w.
TEST(LogisticModel, OfSeparableRowsIsFinite) {
  const FeatureMatrix features{{"x"}, {-1, -1, 1, 1}};
  const LogisticModel model = LogisticModel::train(features, std::vector<int>{0, 0, 1, 1});
  const double w = model.weights()[0];
  EXPECT_NEAR(4 / (1 + std::exp(w)), w, 1e-8);
  EXPECT_NEAR(model.predict(features)[3], 1 / (1 + std::exp(-w)), 1e-12);
}

// A column's unit does not matter.
TEST(LogisticModel, IsInvariantUnderScalingOfAColumn) {
  std::vector<int> labels;
  FeatureMatrix features = normal_classes(300, 1, labels);
  const std::vector<double> before = LogisticModel::train(features, labels).predict(features);
  for (std::size_t i = 0; i < 300; ++i) features.values[3 * i] *= 1024;
  const std::vector<double> after = LogisticModel::train(features, labels).predict(features);
  for (std::size_t i = 0; i < 300; ++i) EXPECT_NEAR(after[i], before[i], 1e-9);
}

TEST(LogisticModel, OfOneClassIsCertainOfIt) {
  const FeatureMatrix features{{"x"}, {1, 2, 3}};
  for (const double p : LogisticModel::train(features, std::vector<int>{1, 1, 1}).predict(features)) EXPECT_GT(p, 0.99);
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Logistic regression against closed forms and the conditions of its minimum.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>

#include "classify/model/classifiers.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/temporary_folder.h"

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
  EXPECT_NEAR(model.offsets()[0], 0, 0.08);
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

// Three classes with x of means -m, 0 and m.
FeatureMatrix three_classes(std::size_t rows, std::vector<int>& labels) {
  FeatureMatrix features{{"x", "noise", "constant"}, {}};
  for (std::size_t i = 0; i < rows; ++i) {
    Random random({6, Stream::kTest, i});
    labels.push_back(static_cast<int>(random.below(3)));
    features.values.push_back(static_cast<float>(1.5 * (labels.back() - 1) + random.normal()));
    features.values.push_back(static_cast<float>(random.normal()));
    features.values.push_back(3);
  }
  return features;
}

// The odds of two of three normal classes of equal deviation are exp((m_a - m_b) x + const).
TEST(MultinomialModel, HasTheOddsOfThreeNormalClasses) {
  std::vector<int> labels;
  const FeatureMatrix features = three_classes(20000, labels);
  const LogisticModel model = LogisticModel::train(features, labels, 3);
  const std::vector<double>& w = model.weights();
  ASSERT_EQ(w.size(), 9u);
  const double deviation = std::sqrt(1 + 1.5 * 1.5 * 2 / 3);  // of x
  EXPECT_NEAR((w[3] - w[0]) / deviation, 1.5, 0.08);          // three standard errors
  EXPECT_NEAR((w[6] - w[3]) / deviation, 1.5, 0.08);
  EXPECT_NEAR(w[4] - w[1], 0, 0.08);
  EXPECT_EQ(w[2], 0);
  EXPECT_NEAR(model.offsets()[0] + model.offsets()[1] + model.offsets()[2], 0, 1e-6);
}

// Sums of (p_k - y_k) z are -w_k, those of (p_k - y_k) zero; probabilities of a row sum to one.
TEST(MultinomialModel, IsAtTheMinimumOfItsPenalisedLikelihood) {
  constexpr std::size_t kRows = 300;
  std::vector<int> labels;
  const FeatureMatrix features = three_classes(kRows, labels);
  const LogisticModel model = LogisticModel::train(features, labels, 3);
  const std::vector<double> p = model.predict(features);
  double mean = 0, squares = 0;
  for (std::size_t i = 0; i < kRows; ++i) mean += features.row(i)[0] / static_cast<double>(kRows);
  for (std::size_t i = 0; i < kRows; ++i) squares += std::pow(features.row(i)[0] - mean, 2) / kRows;
  for (std::size_t k = 0; k < 3; ++k) {
    double along = 0, sum = 0;
    for (std::size_t i = 0; i < kRows; ++i) {
      const double rest = p[3 * i + k] - (labels[i] == static_cast<int>(k) ? 1 : 0);
      along += rest * (features.row(i)[0] - mean) / std::sqrt(squares);
      sum += rest;
    }
    EXPECT_NEAR(along, -model.weights()[3 * k], 1e-6) << k;
    EXPECT_NEAR(sum, 0, 1e-6) << k;
  }
  for (std::size_t i = 0; i < kRows; ++i) EXPECT_NEAR(p[3 * i] + p[3 * i + 1] + p[3 * i + 2], 1, 1e-12);
}

// Without information the probabilities are the frequencies of the classes.
TEST(MultinomialModel, OfAConstantColumnHasTheFrequencies) {
  const FeatureMatrix features{{"constant"}, std::vector<float>(10, 2.0f)};
  const std::vector<double> p =
      LogisticModel::train(features, std::vector<int>{0, 0, 0, 0, 0, 1, 1, 1, 2, 2}, 3).predict(features);
  EXPECT_NEAR(p[0], 0.5, 1e-8);
  EXPECT_NEAR(p[1], 0.3, 1e-8);
  EXPECT_NEAR(p[2], 0.2, 1e-8);
}

// With no row of a third class the weights of the other two are +-w / 2, whose penalty is half of the model's of two
// classes: the same minimum as with every row twice.
TEST(MultinomialModel, OfTwoClassesIsTheModelOfTwoWithHalfThePenalty) {
  std::vector<int> labels;
  FeatureMatrix features = normal_classes(200, 0.7, labels);
  const std::vector<double> three = LogisticModel::train(features, labels, 3).predict(features);
  FeatureMatrix twice = features;
  twice.values.insert(twice.values.end(), features.values.begin(), features.values.end());
  std::vector<int> labels_twice = labels;
  labels_twice.insert(labels_twice.end(), labels.begin(), labels.end());
  const std::vector<double> two = LogisticModel::train(twice, labels_twice).predict(features);
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_NEAR(three[3 * i + 1], two[i], 1e-6) << i;
    EXPECT_LT(three[3 * i + 2], 1e-6);
  }
}

}  // namespace

// Trees whose nodes, columns or classes are not those of a model are refused before XGBoost follows their indices.

namespace {

using nlohmann::json;
using testing::HasSubstr;

// Classes in turn along one of two columns.
FeatureMatrix rows(std::size_t count) {
  FeatureMatrix features{{"a", "b"}, {}};
  for (std::size_t i = 0; i < count; ++i) features.values.insert(features.values.end(), {float(i % 7), float(i)});
  return features;
}

class TreeCheck : public testing::Test {
 protected:
  json trained(std::size_t classes) const {
    LearningSpec spec;
    spec.trees = 3;
    std::vector<int> labels;
    for (std::size_t i = 0; i < 60; ++i) labels.push_back(static_cast<int>(i / 5 % classes));
    Booster::train(rows(60), labels, spec, nullptr, classes).save(file_);
    return json::parse(read_file(file_));
  }
  std::string refusal(const json& model) const {
    try {
      require_sound_trees(model.dump(), "handmade.json");
    } catch (const InputError& error) {
      std::string text = error.what();
      EXPECT_TRUE(text.starts_with("handmade.json: not the trees of a model: ")) << text;
      return text;
    }
    return "accepted";
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "trees.json";
};

TEST_F(TreeCheck, AcceptsModelsOfTwoAndMoreClasses) {
  for (const std::size_t classes : {2u, 3u, 10u}) {
    EXPECT_EQ(refusal(trained(classes)), "accepted");
    const Booster loaded = Booster::load(file_);
    EXPECT_EQ(loaded.classes(), classes);
    EXPECT_EQ(loaded.columns(), 2u);
    EXPECT_EQ(loaded.predict(rows(4)).size(), classes == 2 ? 4 : 4 * classes);
  }
}

TEST_F(TreeCheck, RefusesTreesThatXgboostWouldFollowOutsideOfTheirArrays) {
  struct Case {
    const char* what;
    std::function<void(json&)> change;  // of the first tree
    const char* reason;
  };
  const std::vector<Case> cases{
      {"child outside", [](json& tree) { tree["left_children"][0] = 100'000'000; }, "tree 0: left_children: 100000000"},
      {"child below", [](json& tree) { tree["right_children"][0] = -5; }, "tree 0: right_children: -5"},
      {"child beyond 64 bits", [](json& tree) { tree["left_children"][0] = 18'446'744'073'709'551'615ull; },
       "left_children: 18446744073709551615"},
      {"circle", [](json& tree) { tree["left_children"][1] = tree["right_children"][1] = 0; }, "has another parent"},
      {"own child", [](json& tree) { tree["left_children"][1] = tree["right_children"][1] = tree["parents"][1] = 1; },
       "node 0: 1 has another parent"},
      {"same child", [](json& tree) { tree["left_children"][0] = tree["right_children"][0]; }, "is reached twice"},
      {"one child", [](json& tree) { tree["left_children"][0] = -1; }, "node 0: one child"},
      {"column", [](json& tree) { tree["split_indices"][0] = 2; },
       "split_indices: 2, must be a whole number from 0 to 1"},
      {"column below", [](json& tree) { tree["split_indices"][0] = -1; }, "split_indices: -1"},
      {"fraction", [](json& tree) { tree["split_indices"][0] = 0.5; }, "split_indices: 0.5"},
      {"parent", [](json& tree) { tree["parents"][1] = 1'000'000; }, "parents: 1000000 of node 1"},
      {"parent of the first", [](json& tree) { tree["parents"][0] = 0; }, "parents: 0 of node 0"},
      {"category", [](json& tree) { tree["split_type"][0] = 1; }, "split_type: 1"},
      {"categories", [](json& tree) { tree["categories"] = {5}; }, "categories: must be an array of 0"},
      {"short", [](json& tree) { tree["base_weights"] = {1.0}; }, "base_weights: must be an array of"},
      {"value", [](json& tree) { tree["split_conditions"][0] = 1e39; },
       "split_conditions: 1e+39, must be a finite number"},
      {"nodes", [](json& tree) { tree["tree_param"]["num_nodes"] = "2000000000"; }, "must be an array of 2000000000"},
      {"no nodes", [](json& tree) { tree["tree_param"]["num_nodes"] = "0"; }, "num_nodes: '0', must be 1 to"},
      {"number", [](json& tree) { tree["tree_param"]["num_nodes"] = "0x7"; }, "num_nodes: '0x7'"},
      {"columns", [](json& tree) { tree["tree_param"]["num_feature"] = "3"; }, "num_feature: '3', must be 2"},
      {"no key", [](json& tree) { tree.erase("parents"); }, "tree 0: key 'parents' not found"}};
  const json model = trained(2);
  for (const Case& one : cases) {
    json changed = model;
    one.change(changed["learner"]["gradient_booster"]["model"]["trees"][0]);
    EXPECT_THAT(refusal(changed), HasSubstr(one.reason)) << one.what;
  }
}

TEST_F(TreeCheck, RefusesModelsOfAnotherKind) {
  struct Case {
    std::function<void(json&)> change;  // of the learner
    const char* reason;
  };
  const auto model_of = [](json& learner) -> json& { return learner["gradient_booster"]["model"]; };
  const std::vector<Case> cases{
      {[](json& learner) { learner["objective"]["name"] = "reg:squarederror"; }, "objective: 'reg:squarederror'"},
      {[](json& learner) { learner["gradient_booster"]["name"] = "dart"; }, "gradient_booster: must be 'gbtree'"},
      {[](json& learner) { learner["learner_model_param"]["num_class"] = "1000000000"; }, "num_class: '1000000000'"},
      {[](json& learner) { learner["learner_model_param"]["num_target"] = "1000000000"; }, "num_target: '1000000000'"},
      {[](json& learner) { learner["learner_model_param"]["num_feature"] = "0"; }, "num_feature: '0'"},
      {[](json& learner) { learner["learner_model_param"]["base_score"] = "nan"; }, "base_score: 'nan'"},
      {[&](json& learner) { model_of(learner)["trees"] = json::array(); }, "trees: must be an array of at least one"},
      {[&](json& learner) { model_of(learner)["tree_info"][0] = 3; },
       "tree_info: 3, must be a whole number from 0 to 2"},
      {[&](json& learner) { model_of(learner)["tree_info"].push_back(0); }, "tree_info: must be an array of"},
      {[&](json& learner) { model_of(learner)["gbtree_model_param"]["num_trees"] = "999999999"; }, "num_trees: "},
      {[](json& learner) { learner = nullptr; }, "cannot use at() with null"}};
  const json model = trained(3);
  for (const Case& one : cases) {
    json changed = model;
    one.change(changed["learner"]);
    EXPECT_THAT(refusal(changed), HasSubstr(one.reason));
  }
  EXPECT_THROW(require_sound_trees("", "x"), InputError);
  EXPECT_THROW(require_sound_trees(R"({"learner": )" + std::string(100'000, '['), "x"), InputError);
  EXPECT_THROW(require_sound_trees(R"({"learner": {}, "learner": {}})", "x"), InputError);
}

}  // namespace

}  // namespace seaglint

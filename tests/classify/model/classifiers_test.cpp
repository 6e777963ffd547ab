// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <set>

#include "classify/model/classifiers.h"
#include "classify/model/data_rows.h"
#include "classify/model/division.h"
#include "classify/model/scores.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using testing::ElementsAre;

// Logistic regression against closed forms and the conditions of its minimum.

// Normal classes of deviation 1, their means `step` apart and about zero: the odds of two are exp(step x + const).
FeatureMatrix normal_classes(std::size_t rows, int classes, double step, std::vector<int>& labels) {
  FeatureMatrix features{{"x", "noise", "constant"}, {}};
  for (std::size_t i = 0; i < rows; ++i) {
    Random random({static_cast<std::uint64_t>(classes) + 3, Stream::kTest, i});
    labels.push_back(static_cast<int>(random.below(static_cast<std::uint32_t>(classes))));
    features.values.push_back(static_cast<float>(step * (labels.back() - 0.5 * (classes - 1)) + random.normal()));
    features.values.push_back(static_cast<float>(random.normal()));
    features.values.push_back(3);
  }
  return features;
}

TEST(LogisticModel, HasTheOddsOfTwoNormalClasses) {
  std::vector<int> labels;
  const FeatureMatrix features = normal_classes(20000, 2, 1.4, labels);
  const LogisticModel model = LogisticModel::train(features, labels);
  // x has the deviation sqrt(1 + m^2); the weight's standard error is about 2 / sqrt(n (1 + ...)) = 0.02.
  EXPECT_NEAR(model.weights()[0] / std::sqrt(1 + 0.49), 1.4, 0.08);
  EXPECT_NEAR(model.weights()[1], 0, 0.08);
  EXPECT_EQ(model.weights()[2], 0);
  EXPECT_NEAR(model.offsets()[0], 0, 0.08);
}

// The gradient of the penalised likelihood: sums of (p_k - y_k) z are -w_k, those of (p_k - y_k) zero.
void expect_minimum(const LogisticModel& model, const FeatureMatrix& features, const std::vector<int>& labels,
                    std::size_t outputs) {
  const std::vector<double> p = model.predict(features);
  const double rows = static_cast<double>(labels.size());
  double mean = 0, squares = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) mean += features.row(i)[0] / rows;
  for (std::size_t i = 0; i < labels.size(); ++i) squares += std::pow(features.row(i)[0] - mean, 2) / rows;
  for (std::size_t k = 0; k < outputs; ++k) {
    double along = 0, sum = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const bool is_class = labels[i] == static_cast<int>(outputs == 1 ? 1 : k);
      const double rest = p[outputs * i + k] - (is_class ? 1 : 0);
      along += rest * (features.row(i)[0] - mean) / std::sqrt(squares);
      sum += rest;
    }
    EXPECT_NEAR(along, -model.weights()[3 * k], 1e-6) << k;
    EXPECT_NEAR(sum, 0, 1e-6) << k;
  }
}

TEST(LogisticModel, IsAtTheMinimumOfItsPenalisedLikelihood) {
  std::vector<int> labels;
  const FeatureMatrix features = normal_classes(400, 2, 3, labels);
  expect_minimum(LogisticModel::train(features, labels), features, labels, 1);
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
  FeatureMatrix features = normal_classes(300, 2, 2, labels);
  const std::vector<double> before = LogisticModel::train(features, labels).predict(features);
  for (std::size_t i = 0; i < 300; ++i) features.values[3 * i] *= 1024;
  const std::vector<double> after = LogisticModel::train(features, labels).predict(features);
  for (std::size_t i = 0; i < 300; ++i) EXPECT_NEAR(after[i], before[i], 1e-9);
}

TEST(LogisticModel, OfOneClassIsCertainOfIt) {
  const FeatureMatrix features{{"x"}, {1, 2, 3}};
  for (const double p : LogisticModel::train(features, std::vector<int>{1, 1, 1}).predict(features)) EXPECT_GT(p, 0.99);
}

TEST(MultinomialModel, HasTheOddsOfThreeNormalClasses) {
  std::vector<int> labels;
  const FeatureMatrix features = normal_classes(20000, 3, 1.5, labels);
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

// Probabilities of a row sum to one.
TEST(MultinomialModel, IsAtTheMinimumOfItsPenalisedLikelihood) {
  std::vector<int> labels;
  const FeatureMatrix features = normal_classes(300, 3, 1.5, labels);
  const LogisticModel model = LogisticModel::train(features, labels, 3);
  expect_minimum(model, features, labels, 3);
  const std::vector<double> p = model.predict(features);
  for (std::size_t i = 0; i < 300; ++i) EXPECT_NEAR(p[3 * i] + p[3 * i + 1] + p[3 * i + 2], 1, 1e-12);
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
  FeatureMatrix features = normal_classes(200, 2, 1.4, labels);
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

// Trees whose nodes, columns or classes are not those of a model are refused before XGBoost follows their indices.

using nlohmann::json;

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
    const std::string text = refusal_of([&] { require_sound_trees(model.dump(), "handmade.json"); });
    EXPECT_TRUE(text == "accepted" || text.starts_with("handmade.json: not the trees of a model: ")) << text;
    return text;
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
    EXPECT_HAS(refusal(changed), one.reason) << one.what;
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
    EXPECT_HAS(refusal(changed), one.reason);
  }
  EXPECT_THROW(require_sound_trees("", "x"), InputError);
  EXPECT_THROW(require_sound_trees(R"({"learner": )" + std::string(100'000, '['), "x"), InputError);
  EXPECT_THROW(require_sound_trees(R"({"learner": {}, "learner": {}})", "x"), InputError);
}

// Divisions by columns, bins of columns and ranges over the training maps.

// Ten seas; in each a ship, a ring and a line of reflectors at two azimuths.
struct Maps {
  std::vector<DataRow> rows;
  std::vector<RowGroup> seas;
  std::vector<int> labels;

  Maps() {
    for (int sea = 0; sea < 10; ++sea) {
      for (const char* target : {"ship", "ring", "line"}) {
        for (const double azimuth_deg : {30.0, 80.0}) {
          DataRow row;
          row.record.target_name = target;
          row.record.label = row.record.target_name == "ship" ? 1 : 0;
          row.record.azimuth_deg = azimuth_deg;
          row.record.seed = 42;
          row.record.sea_key = 1000000 * (sea / 5) + sea % 5;
          row.record.significant_wave_height_m = sea < 5 ? 1 : 2;
          rows.push_back(row);
          seas.push_back({sea, sea / 5});
          labels.push_back(static_cast<int>(row.record.label));
        }
      }
    }
  }
  Division division(const DivisionRequest& request) const { return make_division(rows, seas, labels, request); }
};

std::set<std::int64_t> seas_of(const Maps& maps, const std::vector<std::size_t>& rows) {
  std::set<std::int64_t> seas;
  for (const std::size_t row : rows) seas.insert(maps.seas[row].group);
  return seas;
}

std::set<std::string> targets_of(const Maps& maps, const std::vector<std::size_t>& rows) {
  std::set<std::string> names;
  for (const std::size_t row : rows) names.insert(maps.rows[row].record.target_name);
  return names;
}

std::string refusal(const Maps& maps, const DivisionRequest& request) {
  return refusal_of([&] { maps.division(request); });
}

TEST(Division, BySeaIsTheSplitOfSeas) {
  const Maps maps;
  const Split a = divide(maps.division({}), Protocol::kGroup, 0.7, 42, 3);
  const Split b = split_rows(maps.seas, Protocol::kGroup, 0.7, 42, 3);
  EXPECT_EQ(a.train, b.train);
  EXPECT_EQ(a.test, b.test);
}

TEST(Division, ByAColumnKeepsEveryValueOnOneSide) {
  const Maps maps;
  const Split split = divide(maps.division({"azimuth_deg", {}}), Protocol::kGroup, 0.5, 42, 0);
  ASSERT_EQ(split.train.size(), 30u);
  ASSERT_EQ(split.test.size(), 30u);
  const double trained = maps.rows[split.train.front()].record.azimuth_deg;
  for (const std::size_t row : split.train) EXPECT_EQ(maps.rows[row].record.azimuth_deg, trained);
  for (const std::size_t row : split.test) EXPECT_NE(maps.rows[row].record.azimuth_deg, trained);
}

// Every sea has rings, lines and ships: seas are divided 7:3, so that ships are on both sides, in different seas.
TEST(Division, HoldsALayoutOutOfTheTrainingAndTestsNoOtherLayout) {
  const Maps maps;
  for (std::uint64_t repeat = 0; repeat < 20; ++repeat) {
    const Split split = divide(maps.division({"sea", {{"target_name", "ring"}}}), Protocol::kGroup, 0.7, 42, repeat);
    EXPECT_THAT(targets_of(maps, split.train), ElementsAre("line", "ship"));
    EXPECT_THAT(targets_of(maps, split.test), ElementsAre("ring", "ship"));
    const std::set<std::int64_t> trained = seas_of(maps, split.train), tested = seas_of(maps, split.test);
    EXPECT_EQ(trained.size(), 7u);
    EXPECT_EQ(tested.size(), 3u);
    for (const std::int64_t sea : tested) EXPECT_FALSE(trained.contains(sea));
  }
}

// A wave height is that of whole seas: all of these are tested and all others trained on.
TEST(Division, HoldsAWaveHeightOutWithAllItsSeas) {
  const Maps maps;
  for (const char* value : {"2", "1.5:2.5"}) {
    const Split split =
        divide(maps.division({"sea", {{"significant_wave_height_m", value}}}), Protocol::kGroup, 0.7, 42, 0);
    EXPECT_THAT(seas_of(maps, split.train), ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(seas_of(maps, split.test), ElementsAre(5, 6, 7, 8, 9));
  }
}

TEST(Division, HoldsOutAnyValueOfAColumnAndAllColumns) {
  const Maps maps;
  const std::vector<bool> either = maps.division({"sea", {{"target_name", "ring"}, {"target_name", "line"}}}).held_out;
  EXPECT_EQ(std::count(either.begin(), either.end(), true), 40);
  const std::vector<bool> both = maps.division({"sea", {{"target_name", "ring"}, {"azimuth_deg", "80"}}}).held_out;
  EXPECT_EQ(std::count(both.begin(), both.end(), true), 10);
}

TEST(Division, RefusesWhatLeavesNothing) {
  const Maps maps;
  EXPECT_HAS(refusal(maps, {"azimut_deg", {}}), "azimut_deg: no column of a data set: did you mean");
  EXPECT_HAS(refusal(maps, {"sea", {{"target_name", "grid"}}}),
             "target_name=grid: no map has this value; the data have line, ring, ship");
  EXPECT_HAS(refusal(maps, {"sea", {{"azimuth_deg", "0:90"}}}), "all 60 maps are held out");
  EXPECT_HAS(refusal(maps, {"sea", {{"azimuth_deg", "east"}}}), "must be a number or LOW:HIGH");
  EXPECT_HAS(refusal(maps, {"sea", {{"azimuth_deg", "90:0"}}}), "must be a number or LOW:HIGH");
}

TEST(DataRows, OfOneSeedAndKeyAreInOneSeaWhateverTheirDataSet) {
  std::vector<DataRow> rows(4);
  rows[0].record.seed = 42;
  rows[0].record.sea_key = 3;
  rows[1] = rows[0];
  rows[1].data_set = 1;
  rows[2] = rows[0];
  rows[2].record.sea_key = 1;
  rows[3] = rows[0];
  rows[3].record.seed = 7;
  EXPECT_THAT(sea_numbers(rows), ElementsAre(2, 2, 1, 0));
}

TEST(DataRows, HaveTheKeysThatTheirScenariosDraw) {
  std::vector<DataRow> rows(3);
  rows[0].record.drawn_numbers = {{"sea.peak_period_s", 7.5}};
  rows[2].record.drawn_numbers = {{"sea.peak_period_s", 9}};
  rows[2].record.drawn_words = {{"targets.decoys.layout", "ring"}};
  const ColumnOfRows periods = column_of(rows, "sea.peak_period_s");
  EXPECT_FALSE(periods.is_text);
  EXPECT_EQ(periods.numbers[0], 7.5);
  EXPECT_TRUE(std::isnan(periods.numbers[1]));
  EXPECT_THAT(column_of(rows, "targets.decoys.layout").texts, ElementsAre("", "", "ring"));
  EXPECT_THROW(column_of(rows, "sea.gamma"), InputError);
}

TEST(ColumnBins, OfManyValuesHaveEqualNumbersOfRowsAndKeepEqualValuesTogether) {
  ColumnOfRows column{"x", "m", false, {}, {}};
  for (int i = 99; i >= 0; --i) column.numbers.push_back(i);
  const std::vector<ColumnBin> bins = bins_of(column, 8, 5);
  ASSERT_EQ(bins.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(bins[i].rows.size(), 20u);
    EXPECT_EQ(bins[i].lowest, 20.0 * static_cast<double>(i));
    EXPECT_EQ(bins[i].highest, 20.0 * static_cast<double>(i) + 19);
  }
  // Half of the rows have one value: they are a bin of their own.
  for (std::size_t i = 0; i < 50; ++i) column.numbers[i] = 200;
  std::size_t rows = 0;
  for (const ColumnBin& bin : bins_of(column, 8, 5)) rows += bin.rows.size();
  EXPECT_EQ(rows, 100u);
  EXPECT_EQ(bins_of(column, 8, 5).back().rows.size(), 50u);
}

TEST(ColumnBins, OfFewValuesAreTheValuesAndUndefinedOnesComeLast) {
  const ColumnOfRows column{"x", "dB", false, {10, std::nan(""), 20, 10}, {}};
  const std::vector<ColumnBin> bins = bins_of(column, 8, 5);
  ASSERT_EQ(bins.size(), 3u);
  EXPECT_EQ(bins[0].text, "10");
  EXPECT_THAT(bins[0].rows, ElementsAre(0u, 3u));
  EXPECT_THAT(bins[1].rows, ElementsAre(2u));
  EXPECT_EQ(bins[2].text, "undefined");
  EXPECT_THAT(bins[2].rows, ElementsAre(1u));
}

TEST(ValueRange, OfTheTrainingRowsExcludesWhatIsBeyondThem) {
  const ColumnOfRows column{"mwr", "(m/s)^2", false, {1, 5, 3, 100}, {}};
  const std::vector<std::size_t> trained{0, 1, 2};
  const ValueRange range = range_of(column, trained, std::vector<int>{0, 1, 0, 1}, 2);
  EXPECT_EQ(range.lowest, 1);
  EXPECT_EQ(range.highest, 5);
  EXPECT_EQ(range.by_label[0][1], 2);  // median of 1 and 3
  EXPECT_EQ(range.by_label[1][1], 5);
  EXPECT_FALSE(range.excludes(1));
  EXPECT_FALSE(range.excludes(5));
  EXPECT_FALSE(range.excludes(5.004));  // 0.1 % of 5 is 0.005
  EXPECT_TRUE(range.excludes(0.99));
  EXPECT_TRUE(range.excludes(100));
  EXPECT_TRUE(range.excludes(std::nan("")));
}

// Without clutter in training an SCR is outside, and none is inside.
TEST(ValueRange, OfAnUndefinedColumnExcludesEveryValue) {
  const ColumnOfRows column{"scr_peak_cell_db", "dB", false, {std::nan(""), std::nan("")}, {}};
  const std::vector<std::size_t> trained{0, 1};
  const ValueRange range = range_of(column, trained, std::vector<int>{0, 1}, 2);
  EXPECT_TRUE(range.excludes(20));
  EXPECT_FALSE(range.excludes(std::nan("")));
}

// By hand: 0.05 and 0.15 of label 0, 0.95 twice of labels 1 and 0.
TEST(Calibration, OfASmallExampleByHand) {
  std::vector<Prediction> predictions;
  for (const auto& [probability, label] : {std::pair(0.05, 0), {0.15, 0}, {0.95, 1}, {0.95, 0}})
    predictions.push_back({0, 0, label, probability});
  const Calibration result = calibration(predictions);
  ASSERT_EQ(result.bins.size(), 10u);
  EXPECT_EQ(result.bins[9].rows, 2u);
  EXPECT_DOUBLE_EQ(result.bins[9].fraction, 0.5);
  // (0.05 + 0.15 + |1.9 - 1|) / 4
  EXPECT_NEAR(result.expected_error, 0.275, 1e-12);
  EXPECT_TRUE(std::isnan(result.bins[5].fraction));
  EXPECT_TRUE(std::isnan(calibration({}).expected_error));
}

}  // namespace
}  // namespace seaglint

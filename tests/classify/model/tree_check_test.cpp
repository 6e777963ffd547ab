// SPDX-License-Identifier: BSD-3-Clause
// Trees whose nodes, columns or classes are not those of a model are refused before XGBoost follows their indices.
#include "classify/model/classifiers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/temporary_folder.h"

namespace seaglint {
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

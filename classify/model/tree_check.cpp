// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/tree_check.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/text/json_keys.h"
#include "sim/core/text/json_problem.h"
#include "sim/core/text/number.h"
#include "sim/core/text/shown.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

namespace {

using nlohmann::json;

constexpr std::int64_t kMaxColumns = 10'000;
constexpr std::int64_t kNone = -1;                   // child of a leaf
constexpr std::int64_t kNoParent = (1ll << 31) - 1;  // of the first node

[[noreturn]] void fail(const std::string& what) { throw InputError(what); }

// A whole number that XGBoost stores as text.
std::int64_t parameter(const json& object, const char* key, std::int64_t lowest, std::int64_t highest) {
  const std::string text = object.at(key).get<std::string>();
  const std::optional<std::int64_t> value = parse_integer(text);
  if (!value || *value < lowest || *value > highest)
    fail(fmt::format("{}: {}, must be {}", key, in_quotes(text),
                     lowest == highest ? std::to_string(lowest) : fmt::format("{} to {}", lowest, highest)));
  return *value;
}

// An array with one entry for each of `count` nodes or trees.
const json& array_of(const json& object, const char* key, std::size_t count) {
  const json& array = object.at(key);
  if (!array.is_array() || array.size() != count) fail(fmt::format("{}: must be an array of {}", key, count));
  return array;
}

std::vector<std::int64_t> integers(const json& object, const char* key, std::size_t count, std::int64_t lowest,
                                   std::int64_t highest) {
  std::vector<std::int64_t> values;
  for (const json& entry : array_of(object, key, count)) {
    const bool is_beyond =
        entry.is_number_unsigned() && entry.get<std::uint64_t>() > static_cast<std::uint64_t>(highest);
    const bool is_whole = entry.is_boolean() || (entry.is_number_integer() && !is_beyond);
    values.push_back(is_whole ? entry.get<std::int64_t>() : lowest - 1);
    if (values.back() < lowest || values.back() > highest)
      fail(fmt::format("{}: {}, must be a whole number from {} to {}", key, shown(entry.dump()), lowest, highest));
  }
  return values;
}

void require_finite(const json& object, const char* key, std::size_t count) {
  for (const json& entry : array_of(object, key, count))
    if (!entry.is_number() || !(std::abs(entry.get<double>()) <= std::numeric_limits<float>::max()))
      fail(fmt::format("{}: {}, must be a finite number", key, shown(entry.dump())));
}

// Throws unless every node that is reached from the first one is its parent's child, with two children or none.
void check_links(const std::vector<std::int64_t>& left, const std::vector<std::int64_t>& right,
                 const std::vector<std::int64_t>& parents) {
  std::vector<bool> is_reached(left.size(), false);
  std::vector<std::int64_t> next{0};
  while (!next.empty()) {
    const std::int64_t node = next.back();
    const auto at = static_cast<std::size_t>(node);
    next.pop_back();
    if (is_reached[at]) fail(fmt::format("node {}: is reached twice", node));
    is_reached[at] = true;
    if (left[at] == kNone && right[at] == kNone) continue;
    for (const std::int64_t child : {left[at], right[at]}) {
      if (child == kNone) fail(fmt::format("node {}: one child, must have two or none", node));
      if (parents[static_cast<std::size_t>(child)] != node)
        fail(fmt::format("node {}: {} has another parent", node, child));
      next.push_back(child);
    }
  }
}

void check_tree(const json& tree, std::int64_t columns) {
  const json& parameters = tree.at("tree_param");
  const std::int64_t nodes = parameter(parameters, "num_nodes", 1, kNoParent - 1);
  const auto count = static_cast<std::size_t>(nodes);
  parameter(parameters, "num_feature", columns, columns);
  parameter(parameters, "size_leaf_vector", 0, 0);
  for (const char* key : {"base_weights", "loss_changes", "split_conditions", "sum_hessian"})
    require_finite(tree, key, count);
  integers(tree, "default_left", count, 0, 1);
  integers(tree, "split_type", count, 0, 0);  // of numbers
  for (const char* key : {"categories", "categories_nodes", "categories_segments", "categories_sizes"})
    array_of(tree, key, 0);
  integers(tree, "split_indices", count, 0, columns - 1);
  const std::vector<std::int64_t> parents = integers(tree, "parents", count, 0, kNoParent);
  for (std::size_t i = 0; i < count; ++i)
    if ((i == 0) != (parents[i] == kNoParent) || (i > 0 && parents[i] >= nodes))
      fail(fmt::format("parents: {} of node {}", parents[i], i));
  check_links(integers(tree, "left_children", count, kNone, nodes - 1),
              integers(tree, "right_children", count, kNone, nodes - 1), parents);
}

void check_learner(const json& learner) {
  const std::string objective = learner.at("objective").at("name").get<std::string>();
  const bool is_binary = objective == "binary:logistic";
  if (!is_binary && objective != "multi:softprob")
    fail(fmt::format("objective: {}, must be 'binary:logistic' or 'multi:softprob'", in_quotes(objective)));
  const json& parameters = learner.at("learner_model_param");
  const std::int64_t columns = parameter(parameters, "num_feature", 1, kMaxColumns);
  const std::int64_t classes = parameter(parameters, "num_class", is_binary ? 0 : 3, is_binary ? 0 : kMaxClasses);
  parameter(parameters, "num_target", 1, 1);
  const std::string base_score = parameters.at("base_score").get<std::string>();
  const std::optional<double> base = parse_number(base_score);
  if (!base || !(*base > 0 && *base < 1))
    fail(fmt::format("base_score: {}, must be above 0 and below 1", in_quotes(base_score)));

  const json& booster = learner.at("gradient_booster");
  if (booster.at("name") != "gbtree") fail("gradient_booster: must be 'gbtree'");
  const json& model = booster.at("model");
  const json& trees = model.at("trees");
  if (!trees.is_array() || trees.empty()) fail("trees: must be an array of at least one");
  const auto count = static_cast<std::int64_t>(trees.size());
  parameter(model.at("gbtree_model_param"), "num_trees", count, count);
  parameter(model.at("gbtree_model_param"), "num_parallel_tree", 1, 1);
  parameter(model.at("gbtree_model_param"), "size_leaf_vector", 0, 0);
  integers(model, "tree_info", trees.size(), 0, is_binary ? 0 : classes - 1);  // class of each tree
  for (std::size_t i = 0; i < trees.size(); ++i) {
    try {
      check_tree(trees[i], columns);
    } catch (const InputError& error) {
      fail(fmt::format("tree {}: {}", i, error.what()));
    } catch (const json::exception& error) {
      fail(fmt::format("tree {}: {}", i, json_problem(error)));
    }
  }
}

}  // namespace

void require_sound_trees(const std::string& text, const std::string& name) {
  check_json(text, name);
  try {
    check_learner(json::parse(text).at("learner"));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: not the trees of a model: {}", name, error.what()));
  } catch (const json::exception& error) {
    throw InputError(fmt::format("{}: not the trees of a model: {}", name, json_problem(error)));
  }
}

}  // namespace seaglint

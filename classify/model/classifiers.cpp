// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/classifiers.h"

#include <fmt/format.h>
#include <xgboost/c_api.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/json.h"
#include "sim/core/text/words.h"
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

namespace {

constexpr std::size_t kMaxBytes = std::size_t{256} << 20;  // of a file

void require(int status, const char* what) {
  if (status != 0) throw WorkError(fmt::format("XGBoost: {}: {}", what, XGBGetLastError()));
}

// The library's matrix of rows, freed by the destructor.
class Rows {
 public:
  explicit Rows(const FeatureMatrix& features) {
    require(
        XGDMatrixCreateFromMat(features.values.data(), features.rows(), features.columns(), std::nanf(""), &handle_),
        "rows");
  }
  ~Rows() { XGDMatrixFree(handle_); }
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;
  DMatrixHandle get() const { return handle_; }

 private:
  DMatrixHandle handle_ = nullptr;
};

// Suppresses the library's messages.
void quieten() { require(XGBSetGlobalConfig(R"({"verbosity": 0})"), "settings"); }

}  // namespace

struct Booster::Model {
  BoosterHandle handle = nullptr;

  explicit Model(const DMatrixHandle* rows) { require(XGBoosterCreate(rows, rows ? 1 : 0, &handle), "model"); }
  ~Model() { XGBoosterFree(handle); }
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  void set(const char* name, const std::string& value) {
    require(XGBoosterSetParam(handle, name, value.c_str()), name);
  }
};

Booster Booster::train(const FeatureMatrix& features, std::span<const int> labels, const LearningSpec& spec,
                       const StopFlag* stop, std::size_t classes) {
  SEAGLINT_CHECK(features.rows() == labels.size() && !labels.empty(),
                 fmt::format("{} rows, {} labels", features.rows(), labels.size()));
  quieten();
  const Rows rows(features);
  const std::vector<float> targets(labels.begin(), labels.end());
  require(XGDMatrixSetFloatInfo(rows.get(), "label", targets.data(), targets.size()), "labels");

  const DMatrixHandle handle = rows.get();
  auto model = std::make_shared<Model>(&handle);
  if (classes == 2) {
    model->set("objective", "binary:logistic");
    model->set("eval_metric", "logloss");
  } else {
    model->set("objective", "multi:softprob");
    model->set("num_class", std::to_string(classes));
    model->set("eval_metric", "mlogloss");
  }
  model->set("tree_method", "hist");
  model->set("nthread", "1");
  model->set("max_depth", std::to_string(spec.max_depth));
  model->set("eta", fmt::format("{}", spec.tree_learning_rate));
  model->set("subsample", fmt::format("{}", spec.subsample));
  model->set("colsample_bytree", fmt::format("{}", spec.colsample_bytree));
  model->set("seed", std::to_string(spec.tree_seed));
  for (int i = 0; i < spec.trees; ++i) {
    if (stop && *stop) throw Interrupted();
    require(XGBoosterUpdateOneIter(model->handle, i, rows.get()), "training");
  }
  return Booster(std::move(model));
}

std::vector<double> Booster::predict(const FeatureMatrix& features) const {
  SEAGLINT_CHECK(features.columns() == columns(),
                 fmt::format("{} columns, trained on {}", features.columns(), columns()));
  if (features.rows() == 0) return {};
  quieten();
  const Rows rows(features);
  const bst_ulong* shape = nullptr;
  bst_ulong dimensions = 0;
  const float* result = nullptr;
  constexpr const char* kSettings =
      R"({"type": 0, "training": false, "iteration_begin": 0, "iteration_end": 0, "strict_shape": false})";
  require(XGBoosterPredictFromDMatrix(model_->handle, rows.get(), kSettings, &shape, &dimensions, &result),
          "prediction");
  bst_ulong count = 1;
  for (bst_ulong i = 0; i < dimensions; ++i) count *= shape[i];
  return std::vector<double>(result, result + count);
}

std::vector<double> Booster::gains(std::size_t columns) const {
  const bst_ulong* shape = nullptr;
  bst_ulong count = 0, dimensions = 0;
  const char** names = nullptr;
  const float* scores = nullptr;
  require(XGBoosterFeatureScore(model_->handle, R"({"importance_type": "total_gain"})", &count, &names, &dimensions,
                                &shape, &scores),
          "gains");
  // The library omits columns without a split; the others are named f0, f1, ...
  std::vector<double> fractions(columns, 0.0);
  double total = 0;
  for (bst_ulong i = 0; i < count; ++i) {
    const std::size_t column = std::strtoul(names[i] + 1, nullptr, 10);
    SEAGLINT_CHECK(column < columns, names[i]);
    fractions[column] = scores[i];
    total += scores[i];
  }
  for (double& fraction : fractions) fraction = total > 0 ? fraction / total : 0;
  return fractions;
}

std::size_t Booster::columns() const {
  bst_ulong count = 0;
  require(XGBoosterGetNumFeature(model_->handle, &count), "columns");
  return count;
}

std::size_t Booster::classes() const {
  bst_ulong length = 0;
  const char* text = nullptr;
  require(XGBoosterSaveJsonConfig(model_->handle, &length, &text), "configuration");
  const std::string configuration(text, length), key = "\"num_class\":\"";
  const std::size_t place = configuration.find(key);
  SEAGLINT_CHECK(place != std::string::npos, "num_class is in XGBoost's configuration");
  const std::size_t classes = std::strtoul(configuration.c_str() + place + key.size(), nullptr, 10);
  return std::max<std::size_t>(classes, 2);  // 0 for binary:logistic
}

void Booster::save(const std::filesystem::path& file) const {
  bst_ulong length = 0;
  const char* bytes = nullptr;
  require(XGBoosterSaveModelToBuffer(model_->handle, R"({"format": "json"})", &length, &bytes), "saving");
  write_file(file, {bytes, length});
}

Booster Booster::load(const std::filesystem::path& file) {
  quieten();
  const std::string bytes = read_file(file, kMaxBytes);
  require_sound_trees(bytes, file.string());
  auto model = std::make_shared<Model>(nullptr);
  if (XGBoosterLoadModelFromBuffer(model->handle, bytes.data(), bytes.size()) != 0)
    throw InputError(fmt::format("{}: not the trees of a model: XGBoost cannot read them", file.string()));
  model->set("nthread", "1");
  return Booster(std::move(model));
}

namespace {

constexpr int kMostSteps = 100;
constexpr double kGradientPerRow = 1e-9;

double logistic(double x) { return 1 / (1 + std::exp(-x)); }

// Solves a x = b for a symmetric, positive definite matrix of b.size() rows; `a` becomes its Cholesky factor.
void solve(std::vector<double>& a, std::vector<double>& b) {
  const std::size_t n = b.size();
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j; i < n; ++i) {
      double rest = a[i * n + j];
      for (std::size_t k = 0; k < j; ++k) rest -= a[i * n + k] * a[j * n + k];
      a[i * n + j] = i == j ? std::sqrt(rest) : rest / a[j * n + j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
}

// Rows of standardised columns, of which the last is 1 for the offset, and their labels. One output: the probability of
// label 1 over that of label 0.
struct LogisticRows {
  std::span<const double> values;
  std::span<const int> labels;
  std::size_t columns, outputs;
};

// Penalised -log likelihood at weights [output][column], its gradient and the lower triangle of its Hessian.
struct LogisticPoint {
  std::vector<double> weights;
  double value = 0;
  std::vector<double> gradient, hessian;

  LogisticPoint(const LogisticRows& rows, std::vector<double> at)
      : weights(std::move(at)), gradient(weights.size()), hessian(weights.size() * weights.size()) {
    add_penalty(rows);
    for (std::size_t i = 0; i < rows.labels.size(); ++i) add_row(rows, i);
  }

 private:
  // The offset of two classes is free, but with one class only it stays finite. Equal shifts of all offsets of more
  // classes change no probability: the term (sum of offsets)^2 / 2 makes the minimum unique without moving it.
  void add_penalty(const LogisticRows& rows) {
    const double of_offsets = rows.outputs == 1 ? 1e-12 : 1;
    const std::size_t n = weights.size(), last = rows.columns - 1;
    double offsets = 0;
    for (std::size_t a = last; a < n; a += rows.columns) offsets += weights[a];
    value = 0.5 * of_offsets * offsets * offsets;
    for (std::size_t a = 0; a < n; ++a) {
      const bool is_offset = a % rows.columns == last;
      gradient[a] = is_offset ? of_offsets * offsets : weights[a];
      if (!is_offset) value += 0.5 * weights[a] * weights[a];
      if (!is_offset) hessian[a * n + a] = 1;
      for (std::size_t b = last; is_offset && b <= a; b += rows.columns) hessian[a * n + b] = of_offsets;
    }
  }

  void add_row(const LogisticRows& rows, std::size_t i) {
    const std::size_t columns = rows.columns, outputs = rows.outputs, n = weights.size();
    const bool is_binary = outputs == 1;
    const std::span<const double> z = rows.values.subspan(i * columns, columns);
    const auto own = static_cast<std::size_t>(rows.labels[i]) - (is_binary ? 1 : 0);  // output of the label
    std::vector<double> p(outputs);
    for (std::size_t a = 0; a < outputs; ++a)
      p[a] = std::inner_product(z.begin(), z.end(), weights.begin() + static_cast<std::ptrdiff_t>(a * columns), 0.0);
    const double highest = is_binary ? std::max(p[0], 0.0) : std::ranges::max(p);
    double sum = is_binary ? std::exp(-highest) : 0;
    value += highest - (own < outputs ? p[own] : 0);
    for (double& x : p) sum += x = std::exp(x - highest);
    value += std::log(sum);
    for (double& x : p) x /= sum;
    for (std::size_t a = 0; a < outputs; ++a) {
      for (std::size_t k = 0; k < columns; ++k) gradient[a * columns + k] += (p[a] - (a == own ? 1 : 0)) * z[k];
      for (std::size_t b = 0; b <= a; ++b) {
        const double curvature = p[a] * ((a == b ? 1 : 0) - p[b]);
        for (std::size_t k = 0; k < columns; ++k) {
          double* const row = &hessian[(a * columns + k) * n + b * columns];
          for (std::size_t l = 0; l < columns; ++l) row[l] += curvature * z[k] * z[l];
        }
      }
    }
  }
};

// Weights at the minimum by Newton's method, with a half, a quarter, ... of a step where the whole does not lower the
// value.
std::vector<double> fitted_weights(const LogisticRows& rows) {
  LogisticPoint here(rows, std::vector<double>(rows.outputs * rows.columns));
  const auto is_steep = [&](double g) {
    return std::abs(g) >= kGradientPerRow * static_cast<double>(rows.labels.size());
  };
  for (int i = 0; i < kMostSteps && std::ranges::any_of(here.gradient, is_steep); ++i) {
    std::vector<double> step = here.gradient;
    solve(here.hessian, step);
    const double before = here.value;
    const std::vector<double> from = here.weights;
    double length = 1;
    do {
      std::vector<double> to = from;
      for (std::size_t k = 0; k < to.size(); ++k) to[k] -= length * step[k];
      here = LogisticPoint(rows, std::move(to));
      length /= 2;
    } while (!(here.value <= before) && length > 5e-7);
    if (!(here.value <= before)) return from;
  }
  return here.weights;
}

}  // namespace

LogisticModel LogisticModel::train(const FeatureMatrix& features, std::span<const int> labels, std::size_t classes) {
  const std::size_t rows = features.rows(), columns = features.columns();
  SEAGLINT_CHECK(rows > 0 && labels.size() == rows, "one label per row");
  LogisticModel model;
  std::vector<double> standardised(rows * (columns + 1), 1.0);
  for (std::size_t k = 0; k < columns; ++k) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < rows; ++i) sum += static_cast<double>(features.row(i)[k]);
    const double mean = sum / static_cast<double>(rows);
    for (std::size_t i = 0; i < rows; ++i) squares += std::pow(static_cast<double>(features.row(i)[k]) - mean, 2);
    const double deviation = std::sqrt(squares / static_cast<double>(rows));
    model.means_.push_back(mean);
    model.scales_.push_back(deviation > 0 ? 1 / deviation : 0);
    for (std::size_t i = 0; i < rows; ++i)
      standardised[i * (columns + 1) + k] = (static_cast<double>(features.row(i)[k]) - mean) * model.scales_[k];
  }
  const std::vector<double> w = fitted_weights({standardised, labels, columns + 1, classes == 2 ? 1 : classes});
  for (auto of_output = w.begin(); of_output != w.end(); of_output += static_cast<std::ptrdiff_t>(columns) + 1) {
    model.weights_.insert(model.weights_.end(), of_output, of_output + static_cast<std::ptrdiff_t>(columns));
    model.offsets_.push_back(of_output[static_cast<std::ptrdiff_t>(columns)]);
  }
  return model;
}

std::vector<double> LogisticModel::predict(const FeatureMatrix& features) const {
  const std::size_t columns = means_.size();
  SEAGLINT_CHECK(features.columns() == columns, "as many columns as in training");
  std::vector<double> probabilities;
  std::vector<double> exponents(offsets_.size());
  for (std::size_t i = 0; i < features.rows(); ++i) {
    for (std::size_t output = 0; output < offsets_.size(); ++output) {
      double x = offsets_[output];
      for (std::size_t k = 0; k < columns; ++k)
        x += weights_[output * columns + k] * (static_cast<double>(features.row(i)[k]) - means_[k]) * scales_[k];
      exponents[output] = x;
    }
    if (exponents.size() == 1) {
      probabilities.push_back(logistic(exponents[0]));
      continue;
    }
    const double highest = *std::max_element(exponents.begin(), exponents.end());
    double sum = 0;
    for (const double x : exponents) sum += std::exp(x - highest);
    for (const double x : exponents) probabilities.push_back(std::exp(x - highest) / sum);
  }
  return probabilities;
}

}  // namespace seaglint

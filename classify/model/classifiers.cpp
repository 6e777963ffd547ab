// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/classifiers.h"

#include <fmt/format.h>
#include <xgboost/c_api.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
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

// log(1 + e^x) without overflow
double softplus(double x) { return std::max(x, 0.0) + std::log1p(std::exp(-std::abs(x))); }

double logistic(double x) { return 1 / (1 + std::exp(-x)); }

using StandardisedRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Standardised columns, and a last one of ones for the offset.
StandardisedRows standardised(const FeatureMatrix& features, std::span<const double> means,
                              std::span<const double> scales) {
  const auto rows = static_cast<Eigen::Index>(features.rows()), columns = static_cast<Eigen::Index>(means.size());
  StandardisedRows z(rows, columns + 1);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const std::span<const float> row = features.row(static_cast<std::size_t>(i));
    for (Eigen::Index k = 0; k < columns; ++k)
      z(i, k) = (static_cast<double>(row[static_cast<std::size_t>(k)]) - means[static_cast<std::size_t>(k)]) *
                scales[static_cast<std::size_t>(k)];
    z(i, columns) = 1;
  }
  return z;
}

// Moves w against a direction of Newton's method, by a half, a quarter, ... of it where the whole does not lower the
// objective, whose value at w is `value`. False, with w unchanged, when none does.
template <class Objective, class Weights>
bool descend(const Objective& objective, const Weights& direction, Weights& w, double& value) {
  double length = 1, next = objective(w - direction);
  while (!(next <= value) && length > 1e-6) {
    length /= 2;
    next = objective(w - length * direction);
  }
  if (!(next <= value)) return false;
  w -= length * direction;
  value = next;
  return true;
}

// Weights of the columns of z, the last that of the offset.
Eigen::VectorXd binary_weights(const StandardisedRows& z, std::span<const int> labels) {
  const std::size_t rows = labels.size();
  Eigen::VectorXd truth(z.rows()), w = Eigen::VectorXd::Zero(z.cols()), penalty = Eigen::VectorXd::Ones(z.cols());
  for (std::size_t i = 0; i < rows; ++i) truth[static_cast<Eigen::Index>(i)] = labels[i];
  penalty[z.cols() - 1] = 1e-12;  // the offset is free; with one class only it stays finite

  const auto objective = [&](const Eigen::VectorXd& at) {
    const Eigen::VectorXd x = z * at;
    double sum = 0.5 * at.cwiseAbs2().dot(penalty);
    for (Eigen::Index i = 0; i < x.size(); ++i) sum += softplus(x[i]) - truth[i] * x[i];
    return sum;
  };
  double value = objective(w);
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::VectorXd p = (z * w).unaryExpr(&logistic);
    const Eigen::VectorXd gradient = z.transpose() * (p - truth) + penalty.cwiseProduct(w);
    if (gradient.cwiseAbs().maxCoeff() < kGradientPerRow * static_cast<double>(rows)) break;
    const Eigen::VectorXd curvature = p.array() * (1 - p.array());
    Eigen::MatrixXd hessian = z.transpose() * curvature.asDiagonal() * z;
    hessian.diagonal() += penalty;
    const Eigen::VectorXd direction = hessian.ldlt().solve(gradient);
    if (!descend(objective, direction, w, value)) break;
  }
  return w;
}

// Probabilities of the classes, [row][class], from their exponents.
Eigen::MatrixXd softmax(const Eigen::MatrixXd& exponents) {
  Eigen::MatrixXd p = (exponents.colwise() - exponents.rowwise().maxCoeff()).array().exp();
  const Eigen::VectorXd sums = p.rowwise().sum();
  p.array().colwise() /= sums.array();
  return p;
}

// [column][class], the last row those of the offsets. Equal shifts of all offsets change no probability: the term
// (sum of offsets)^2 / 2 makes the minimum unique without moving it.
Eigen::MatrixXd multinomial_weights(const StandardisedRows& z, std::span<const int> labels, std::size_t classes) {
  const Eigen::Index columns = z.cols(), count = static_cast<Eigen::Index>(classes), last = columns - 1;
  Eigen::MatrixXd truth = Eigen::MatrixXd::Zero(z.rows(), count), w = Eigen::MatrixXd::Zero(columns, count);
  for (Eigen::Index i = 0; i < z.rows(); ++i) truth(i, labels[static_cast<std::size_t>(i)]) = 1;
  const auto objective = [&](const Eigen::MatrixXd& at) {
    const Eigen::MatrixXd x = z * at;
    const Eigen::VectorXd highest = x.rowwise().maxCoeff();
    const Eigen::VectorXd sums = (x.colwise() - highest).array().exp().rowwise().sum();
    return 0.5 * at.topRows(last).squaredNorm() + 0.5 * std::pow(at.row(last).sum(), 2) +
           (highest.array() + sums.array().log()).sum() - truth.cwiseProduct(x).sum();
  };
  double value = objective(w);
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::MatrixXd p = softmax(z * w);
    Eigen::MatrixXd gradient = z.transpose() * (p - truth);
    gradient.topRows(last) += w.topRows(last);
    gradient.row(last).array() += w.row(last).sum();
    if (gradient.cwiseAbs().maxCoeff() < kGradientPerRow * static_cast<double>(z.rows())) break;
    Eigen::MatrixXd hessian(columns * count, columns * count);
    for (Eigen::Index a = 0; a < count; ++a) {
      for (Eigen::Index b = 0; b < count; ++b) {
        const Eigen::VectorXd curvature = p.col(a).array() * ((a == b ? 1.0 : 0.0) - p.col(b).array());
        auto block = hessian.block(a * columns, b * columns, columns, columns);
        block = z.transpose() * curvature.asDiagonal() * z;
        if (a == b) block.diagonal().head(last).array() += 1;
        block(last, last) += 1;
      }
    }
    const Eigen::VectorXd solved = hessian.ldlt().solve(gradient.reshaped());
    const Eigen::MatrixXd direction = solved.reshaped(columns, count);
    if (!descend(objective, direction, w, value)) break;
  }
  return w;
}

}  // namespace

LogisticModel LogisticModel::train(const FeatureMatrix& features, std::span<const int> labels, std::size_t classes) {
  const std::size_t rows = features.rows(), columns = features.columns();
  SEAGLINT_CHECK(rows > 0 && labels.size() == rows, "one label per row");
  LogisticModel model;
  for (std::size_t k = 0; k < columns; ++k) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < rows; ++i) sum += static_cast<double>(features.row(i)[k]);
    const double mean = sum / static_cast<double>(rows);
    for (std::size_t i = 0; i < rows; ++i) squares += std::pow(static_cast<double>(features.row(i)[k]) - mean, 2);
    const double deviation = std::sqrt(squares / static_cast<double>(rows));
    model.means_.push_back(mean);
    model.scales_.push_back(deviation > 0 ? 1 / deviation : 0);
  }
  const StandardisedRows z = standardised(features, model.means_, model.scales_);
  const Eigen::MatrixXd w =
      classes == 2 ? Eigen::MatrixXd(binary_weights(z, labels)) : multinomial_weights(z, labels, classes);
  for (Eigen::Index k = 0; k < w.cols(); ++k) {
    model.weights_.insert(model.weights_.end(), w.col(k).data(), w.col(k).data() + columns);
    model.offsets_.push_back(w(z.cols() - 1, k));
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

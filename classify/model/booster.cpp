// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/booster.h"

#include <fmt/format.h>
#include <xgboost/c_api.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "classify/model/tree_check.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"

namespace seaglint {

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

}  // namespace seaglint

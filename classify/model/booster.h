// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Gradient-boosted trees (XGBoost: Chen and Guestrin 2016) with the paper's settings (table II), on one thread, so that
// equal rows give bit-identical trees and predictions.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "classify/features/feature_matrix.h"
#include "sim/core/process/parallel.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

// Trained trees: probabilities of the classes of a row.
class Booster {
 public:
  // Labels below `classes`, one per row, at least one row. Two classes: objective binary:logistic, evaluation logloss,
  // spec.trees trees; more: multi:softprob, mlogloss, spec.trees for each class. Tree method hist. Throws Interrupted
  // when *stop becomes true.
  static Booster train(const FeatureMatrix& features, std::span<const int> labels, const LearningSpec& spec,
                       const StopFlag* stop = nullptr, std::size_t classes = 2);
  static Booster load(const std::filesystem::path& file);  // throws InputError when the file is not such a model

  // [row][output]: the probability of label 1 of two classes, of every label of more. Same number of columns as in
  // training.
  std::vector<double> predict(const FeatureMatrix& features) const;
  std::vector<double> gains(std::size_t columns) const;  // fraction of the total gain per column; sums to 1 (or all 0)
  std::size_t columns() const;
  std::size_t classes() const;
  void save(const std::filesystem::path& file) const;  // XGBoost's JSON; throws WorkError

 private:
  struct Model;
  explicit Booster(std::shared_ptr<Model> model) : model_(std::move(model)) {}
  std::shared_ptr<Model> model_;
};

}  // namespace seaglint

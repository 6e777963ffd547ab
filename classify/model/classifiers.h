// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Classifiers of rows of features: gradient-boosted trees (XGBoost: Chen and Guestrin 2016) with the paper's settings
// (table II), on one thread, so that equal rows give bit-identical trees and predictions; and logistic regression, the
// linear baseline beside them.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "classify/features/feature_vector.h"
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

// Checks gradient-boosted trees in XGBoost's JSON (its documentation, "Introduction to Model IO"; version 1.7, src/tree
// and src/gbm): the library follows the indices of the nodes as the file states them. Throws InputError "NAME: not the
// trees of a model: tree 3: split_indices: 9, must be ..." unless the text is a model as Booster::save() writes it:
// objective binary:logistic or multi:softprob, booster gbtree, at least one tree, each of one class. Every array of a
// tree has one entry per node; nodes split at one of the model's columns, by a number; they have two children or none,
// and each is reached once from the first; all numbers are finite in single precision.
void require_sound_trees(const std::string& text, const std::string& name);

// Logistic regression: probability 1 / (1 + exp(-(b + w.z))) of label 1 with the standardised columns z; of more than
// two classes exp(b_k + w_k.z) over the sum of all (multinomial).
class LogisticModel {
 public:
  // Minimises |w|^2 / 2 - sum of log-likelihoods, the penalty of scikit-learn's LogisticRegression with C = 1 (the
  // offset b is free), by Newton's method with halved steps to a gradient of 1e-9 per row. Of more than two classes
  // |w|^2 is the sum over their weights, and the offsets, of which only differences matter, sum to zero. Columns are
  // standardised by their mean and deviation in these rows; a constant one has no weight. Labels below `classes`, one
  // per row, at least one row.
  static LogisticModel train(const FeatureMatrix& features, std::span<const int> labels, std::size_t classes = 2);

  // [row][output]: the probability of label 1 of two classes, of every label of more. Same number of columns as in
  // training.
  std::vector<double> predict(const FeatureMatrix& features) const;

  // [output][column], of standardised columns; [output].
  const std::vector<double>& weights() const { return weights_; }
  const std::vector<double>& offsets() const { return offsets_; }

 private:
  std::vector<double> means_, scales_, weights_, offsets_;  // a scale is 1 / deviation, 0 for a constant column
};

}  // namespace seaglint

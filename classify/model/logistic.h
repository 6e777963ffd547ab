// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Logistic regression, the linear baseline beside the trees: probability 1 / (1 + exp(-(b + w.z))) of label 1 with the
// standardised columns z.

#include <span>
#include <vector>

#include "classify/features/feature_matrix.h"

namespace seaglint {

class LogisticModel {
 public:
  // Minimises |w|^2 / 2 - sum of log-likelihoods, the penalty of scikit-learn's LogisticRegression with C = 1 (the
  // offset b is free), by Newton's method with halved steps to a gradient of 1e-9 per row. Columns are standardised by
  // their mean and deviation in these rows; a constant one has no weight. Labels 0 or 1, one per row, at least one row.
  static LogisticModel train(const FeatureMatrix& features, std::span<const int> labels);

  // Probability of label 1 for each row; same number of columns as in training.
  std::vector<double> predict(const FeatureMatrix& features) const;

  const std::vector<double>& weights() const { return weights_; }  // of standardised columns
  double offset() const { return offset_; }

 private:
  std::vector<double> means_, scales_, weights_;  // a scale is 1 / deviation, 0 for a constant column
  double offset_ = 0;
};

}  // namespace seaglint

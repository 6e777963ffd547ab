// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Logistic regression, the linear baseline beside the trees: probability 1 / (1 + exp(-(b + w.z))) of label 1 with the
// standardised columns z; of more than two classes exp(b_k + w_k.z) over the sum of all (multinomial).

#include <span>
#include <vector>

#include "classify/features/feature_matrix.h"

namespace seaglint {

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

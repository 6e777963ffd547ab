// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scores of predictions, with confidence intervals that account for the dependence of maps of one sea.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "classify/model/data_rows.h"

namespace seaglint {

// Outputs of a classifier for one row: of two classes the probability of label 1, of more that of every label.
constexpr std::size_t outputs_of(std::size_t classes) { return classes == 2 ? 1 : classes; }
// The class of the largest probability; of two, label 1 from probability 1/2 on.
int decision_of(std::span<const double> outputs);

// One prediction of one test row.
struct Prediction {
  std::size_t row = 0;  // of the data, from 0
  std::int64_t group = 0;
  int label = 0;                      // the truth
  double probability = 0;             // of label 1
  std::vector<double> by_class = {};  // of every label where there are more than two; else empty

  std::size_t classes() const { return by_class.empty() ? 2 : by_class.size(); }
  int decision() const;
  double of(int which) const;  // probability of a label
};
// With the outputs of a classifier, of outputs_of() numbers.
Prediction prediction_of(std::size_t row, std::int64_t group, int label, std::span<const double> outputs);

struct ConfidenceInterval {
  double low = 0;
  double high = 0;
};

struct Scores {
  std::size_t rows = 0;
  std::size_t groups = 0;
  double accuracy = 0;  // fraction of right decisions; NaN without rows
  ConfidenceInterval
      accuracy_95;  // percentile bootstrap over groups (Davison and Hinkley 1997, section 5.3); NaN below two groups
  // Area under the ROC: P(a row of label 1 has a larger probability than one of label 0), ties count half; NaN when a
  // class is missing. Of more classes the mean over the pairs of classes that have rows (Hand and Till 2001, eq. 7).
  double auc = 0;
  double log_loss = 0;                              // mean -log of the probability given to the truth, clipped at 1e-7
  std::vector<std::vector<std::size_t>> confusion;  // [truth][decision], of all classes
};

// A threshold of the receiver operating characteristic.
struct RocPoint {
  double false_alarms = 0;  // fraction of label 0 that is declared label 1
  double detections = 0;    // fraction of label 1 that is declared label 1
};

// The receiver operating characteristic from (0, 0) to (1, 1), thresholds descending; rows of equal probability are
// one step, points on a straight line between their neighbours are left out. Of more than `most` points (at least 2)
// every one that is kept is followed by the last whose false_alarms + detections is at most 2 / (most - 1) larger, or
// by the next: less than 2 most points. Empty when a class is missing.
std::vector<RocPoint> roc_curve(std::span<const Prediction> predictions, std::size_t most = 200);

// One curve of two classes; of more one for each label against the rest, over its probability.
std::vector<std::vector<RocPoint>> roc_curves(std::span<const Prediction> predictions);

// Predictions whose probability, of label 1 or among more than two classes the largest, lies within one tenth.
struct CalibrationBin {
  double lowest = 0;  // 0, 0.1, ... 0.9; the last one includes 1
  std::size_t rows = 0;
  double mean_probability = 0;  // NaN without rows
  double fraction = 0;          // of label 1, or of right decisions; NaN without rows
};

struct Calibration {
  std::vector<CalibrationBin> bins;
  // Mean over the rows of |mean probability - fraction| of their bin (Naeini, Cooper and Hauskrecht 2015);
  // NaN without rows.
  double expected_error = 0;
};
Calibration calibration(std::span<const Prediction> predictions);

// Scores of the predictions in one bin of a condition.
struct BinnedScores {
  std::string text;  // as in ColumnBin, with the values of all rows
  double lowest = 0, highest = 0, mean = 0;
  Scores scores;
  std::vector<std::vector<RocPoint>> roc = {};  // roc_curves()
};

struct ConditionScores {
  std::string name;
  std::string unit;
  std::vector<BinnedScores> bins;  // those with predictions, ascending
};

// Stream kBootstrap of (seed, bootstrap_index).
Scores score(std::span<const Prediction> predictions, int bootstrap_samples, std::uint64_t seed,
             std::uint64_t bootstrap_index);

// The same for every bin with predictions; the first has the index bootstrap_index, the next one more.
ConditionScores score_by(const Condition& condition, std::span<const Prediction> predictions, int bootstrap_samples,
                         std::uint64_t seed, std::uint64_t bootstrap_index);

}  // namespace seaglint

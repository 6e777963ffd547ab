// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Ranges of features and conditions over the training maps, and values outside them.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "classify/model/data_rows.h"

namespace seaglint {

// 5, 50 and 95 % quantiles of one class; NaN without a defined value.
using ClassQuantiles = std::array<double, 3>;

// Values of one column over the training maps.
struct ValueRange {
  std::string name;
  std::string unit;
  double lowest = 0;  // NaN when the column is undefined in every training map
  double highest = 0;
  std::vector<ClassQuantiles> by_label;  // of label 0, 1, ...

  bool has_undefined = false;  // some training map has no value

  // True for a value below `lowest` or above `highest` by more than 0.1 % of the larger magnitude of both (a measured
  // ratio of 50.0004 dB is within 50 to 50 dB), for one that is defined where no training map's is, and for an
  // undefined one where all are defined.
  bool excludes(double value) const;
};

// Range of a numeric column over these rows; labels of all rows.
ValueRange range_of(const ColumnOfRows& column, std::span<const std::size_t> rows, std::span<const int> labels,
                    std::size_t classes);

// Columns of a data set that describe the conditions of a map: every real-valued one that is neither a time, a level
// nor among `features`; the number of centres.
std::vector<std::string> condition_names(std::span<const std::string> features);

}  // namespace seaglint

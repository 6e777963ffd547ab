// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Quantiles of samples.

#include <span>
#include <vector>

namespace seaglint {

// Quantile of ascending values at probability p, 0 <= p <= 1, linearly interpolated between the ranks p (n - 1)
// (Hyndman and Fan, The American Statistician 50 (1996) 361, type 7); NaN without values.
double quantile(std::span<const double> ascending, double p);

// Lower quartile, median and upper quartile of the finite values; NaN without any.
struct Quartiles {
  double lower = 0;
  double median = 0;
  double upper = 0;
};
Quartiles quartiles(std::vector<double> values);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Intervals of several accuracies at once, so that with 95 % none of the true values lies outside of its interval when
// chance alone acts.

#include <limits>
#include <span>
#include <vector>

#include "classify/model/scores.h"

namespace seaglint {

// An accuracy with the standard error of its resampled seas.
struct Estimate {
  double value = 0;                                                     // fraction
  double standard_error = 0;                                            // >= 0
  double degrees_of_freedom = std::numeric_limits<double>::infinity();  // of the standard error; >= 1
};

// The estimate whose bootstrap interval of 95 % this is, with the standard error of a sample of its n seas, which is
// that of the bootstrap times sqrt(n / (n - 1)) (Davison and Hinkley 1997, section 2.3); NaN without an interval.
Estimate estimate_of(const Scores& scores);

// Intervals of Student's distribution, which is the normal one for many degrees of freedom, with the levels of Holm's
// procedure (Holm 1979): of m estimates, the one that differs most from `null` in standard errors has the level 0.05 /
// m, the next 0.05 / (m - 1), and so on. Those of Bonferroni would all have 0.05 / m. In the order of `estimates`,
// clipped to [0, 1]; NaN for an estimate that is NaN, which does not count.
std::vector<ConfidenceInterval> holm_intervals(std::span<const Estimate> estimates, double null = 0.5);

// Of each, whether Holm's procedure rejects that it is `null`: its interval and those of all that differ more exclude
// it.
std::vector<bool> holm_rejections(std::span<const Estimate> estimates, double null = 0.5);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a study shows: accuracies of the baselines on unseen seas, of quantities other than motion, and the claims of
// the paper; intervals by Student's distribution.

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "classify/model/scores.h"
#include "classify/model/study.h"

namespace seaglint {

// Intervals of accuracies by Student's distribution: of one, of a difference, and of several at once, so that with 95 %
// none of the true values lies outside of its interval when chance alone acts.

// An accuracy with the standard error of its resampled seas.
struct Estimate {
  double value = 0;                                                     // fraction
  double standard_error = 0;                                            // >= 0
  double degrees_of_freedom = std::numeric_limits<double>::infinity();  // of the standard error; >= 1
};

// The estimate whose bootstrap interval of 95 % this is, with the standard error of a sample of its n seas, which is
// that of the bootstrap times sqrt(n / (n - 1)) (Davison and Hinkley 1997, section 2.3), and its n - 1 degrees of
// freedom, those of a mean of n independent values (Student 1908): seas are the independent units, maps of one sea are
// not. NaN without an interval.
Estimate estimate_of(const Scores& scores);

// Half of the interval that misses the true value with probability `level`: the quantile at 1 - level / 2 with the
// estimate's degrees of freedom, times its standard error.
double half_width(const Estimate& estimate, double level = 0.05);

// a - b of independent estimates. Of estimates on the same maps, which are positively correlated, the standard error is
// too large rather than too small. Degrees of freedom by Welch and Satterthwaite (Welch 1947, Biometrika 34, 28):
// (a^2 + b^2)^2 / (a^4 / d_a + b^4 / d_b) of the standard errors a, b; without any, infinitely many.
Estimate difference_of(const Estimate& a, const Estimate& b);

// half_width() with the levels of Holm's procedure (Holm 1979): of m estimates, the one that differs most from `null`
// in standard errors has the level 0.05 / m, the next 0.05 / (m - 1), and so on. Those of Bonferroni would all have
// 0.05 / m. In the order of `estimates`, clipped to [0, 1]; NaN for an estimate that is NaN, which does not count.
std::vector<ConfidenceInterval> holm_intervals(std::span<const Estimate> estimates, double null = 0.5);

// Of each, whether Holm's procedure rejects that it is `null`: its interval and those of all that differ more exclude
// it.
std::vector<bool> holm_rejections(std::span<const Estimate> estimates, double null = 0.5);

// What a study shows of the paper's claims, by protocol, and what a benchmark states of it: accuracies of the baselines
// on unseen seas and of quantities other than motion.

// A quantity other than motion, classified alone.
struct FloorEntry {
  std::string name;
  Scores scores;       // accuracy_95: Holm's interval over all entries; NaN with one sea
  bool leaks = false;  // Holm's procedure rejects chance
};

// All probes of a study but the features of motion (MWR, CCF, sigma_v). Chance is 1 / number of classes. The study has
// the protocol.
std::vector<FloorEntry> floor_of(const Study& study, Protocol protocol = Protocol::kGroup);

enum class Verdict { kHeld, kNotHeld, kUndecided };
const char* name(Verdict verdict);  // "held", "not held", "undecided"

// A claim of the paper on this data set.
struct Claim {
  std::string text;
  Verdict verdict = Verdict::kUndecided;
  std::string why;      // the figures
  std::string meaning;  // what each verdict follows from
};

// Both verdicts need significance at 5 %, else the claim is undecided: differences by Student's distribution, several
// of one claim by Bonferroni's levels where one of them is enough; quantities other than motion by Holm's procedure. In
// this order: hand-made features above 86 %; both together better than either; hand-made features rise with the wave
// height; trees better than logistic regression; motion alone separates the classes (held: every other quantity is
// within 10 % of chance). The study has the protocol.
std::vector<Claim> claims_of(const Study& study, Protocol protocol = Protocol::kGroup);

// Of a benchmark, beside its study.
struct BenchmarkRecord {
  std::string name;
  bool small = false;
  std::uint64_t seed = 0;
  std::size_t maps = 0, seas = 0;
  int split_repeats = 1;
};

// The content of benchmark.json: the record, `baselines` and `floor` (name -> accuracy, interval, by wave height) and
// `claims`. Fractions; null where undefined.
std::string benchmark_json(const BenchmarkRecord& record, const Study& study);

// The same as a table for the terminal, and as a row of scenarios/benchmarks.md.
std::string benchmark_text(const Study& study);
std::string benchmark_row(const BenchmarkRecord& record, const Study& study);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/benchmark/simultaneous.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"

namespace seaglint {

namespace {

constexpr double kLevel = 0.05;

// Distance from the null in standard errors; an estimate without scatter is certain.
double distance(const Estimate& estimate, double null) {
  const double difference = std::abs(estimate.value - null);
  if (difference == 0) return 0;
  return estimate.standard_error > 0 ? difference / estimate.standard_error : std::numeric_limits<double>::infinity();
}

// Indices of the estimates that are numbers, the most different first; equal ones in their order.
std::vector<std::size_t> most_different_first(std::span<const Estimate> estimates, double null) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (!std::isnan(estimates[i].value) && !std::isnan(estimates[i].standard_error)) order.push_back(i);
  }
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return distance(estimates[a], null) > distance(estimates[b], null); });
  return order;
}

// P(|T| < t) of Student's distribution, t = sqrt(degrees) tan(angle) (Abramowitz and Stegun 1964, 26.7.3 and 26.7.4).
double within(double angle, int degrees) {
  const double sine = std::sin(angle), cosine = std::cos(angle);
  const bool odd = degrees % 2 == 1;
  double sum = 0, term = odd ? cosine : 1;
  for (int power = odd ? 1 : 0; power <= degrees - 2; power += 2) {
    sum += term;
    term *= (power + 1.0) / (power + 2.0) * cosine * cosine;
  }
  return odd ? 2 / kPi * (angle + sine * sum) : sine * sum;
}

// Expansion about the normal quantile to the fourth order (26.7.5); error below 1e-9 from kManyDegrees on.
constexpr double kManyDegrees = 300;
double expanded_quantile(double probability, double degrees) {
  const double z = normal_quantile(probability), z2 = z * z, f = 1 / degrees;
  const double g1 = (z2 + 1) / 4, g2 = ((5 * z2 + 16) * z2 + 3) / 96, g3 = (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384,
               g4 = ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
  return z * (1 + f * (g1 + f * (g2 + f * (g3 + f * g4))));
}

// Half of the interval of an estimate that is the k-th of m.
double half_width(const Estimate& estimate, std::size_t k, std::size_t m) {
  return half_width(estimate, kLevel / static_cast<double>(m - k));
}

}  // namespace

Estimate estimate_of(const Scores& scores) {
  const double of_bootstrap = (scores.accuracy_95.high - scores.accuracy_95.low) / (2 * normal_quantile(0.975));
  const double seas = static_cast<double>(std::max<std::size_t>(scores.groups, 2));
  return {scores.accuracy, of_bootstrap * std::sqrt(seas / (seas - 1)), seas - 1};
}

double student_quantile(double probability, double degrees_of_freedom) {
  if (degrees_of_freedom >= kManyDegrees) return expanded_quantile(probability, degrees_of_freedom);
  const int degrees = static_cast<int>(std::max(1.0, degrees_of_freedom));
  double low = 0, high = kPi / 2;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (low + high) / 2;
    (within(middle, degrees) < 2 * probability - 1 ? low : high) = middle;
  }
  return std::sqrt(degrees) * std::tan((low + high) / 2);
}

double half_width(const Estimate& estimate, double level) {
  return student_quantile(1 - level / 2, estimate.degrees_of_freedom) * estimate.standard_error;
}

Estimate difference_of(const Estimate& a, const Estimate& b) {
  const double of_a = a.standard_error * a.standard_error, of_b = b.standard_error * b.standard_error;
  const double spread = of_a * of_a / a.degrees_of_freedom + of_b * of_b / b.degrees_of_freedom;
  return {a.value - b.value, std::sqrt(of_a + of_b),
          spread > 0 ? (of_a + of_b) * (of_a + of_b) / spread : std::numeric_limits<double>::infinity()};
}

std::vector<ConfidenceInterval> holm_intervals(std::span<const Estimate> estimates, double null) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<ConfidenceInterval> intervals(estimates.size(), {kNone, kNone});
  const std::vector<std::size_t> order = most_different_first(estimates, null);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Estimate& estimate = estimates[order[k]];
    const double half = half_width(estimate, k, order.size());
    intervals[order[k]] = {std::max(0.0, estimate.value - half), std::min(1.0, estimate.value + half)};
  }
  return intervals;
}

std::vector<bool> holm_rejections(std::span<const Estimate> estimates, double null) {
  std::vector<bool> rejected(estimates.size(), false);
  const std::vector<std::size_t> order = most_different_first(estimates, null);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Estimate& estimate = estimates[order[k]];
    if (!(std::abs(estimate.value - null) > half_width(estimate, k, order.size()))) break;
    rejected[order[k]] = true;
  }
  return rejected;
}

}  // namespace seaglint

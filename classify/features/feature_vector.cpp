// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/feature_vector.h"

#include <cmath>
#include <vector>

namespace seaglint {
namespace {

constexpr double kCcfGuard = 1e-6;  // from the paper, avoids 0 / 0

struct Line {
  double slope = 0, offset = 0;
};

// Least squares v = slope r + offset; centres at one range leave the slope undefined: 0 then.
Line fit_line(std::span<const ScatteringCentre> centres, const std::vector<double>& weight) {
  double sum = 0, mean_r = 0, mean_v = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    sum += weight[i];
    mean_r += weight[i] * centres[i].range_m;
    mean_v += weight[i] * centres[i].velocity_mps;
  }
  mean_r /= sum;
  mean_v /= sum;
  double rr = 0, rv = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    rr += weight[i] * (centres[i].range_m - mean_r) * (centres[i].range_m - mean_r);
    rv += weight[i] * (centres[i].range_m - mean_r) * (centres[i].velocity_mps - mean_v);
  }
  const double slope = rr > 1e-12 * sum ? rv / rr : 0;  // ranges within a micrometre count as equal
  return {slope, mean_v - slope * mean_r};
}

}  // namespace

FeatureVector compute_features(std::span<const ScatteringCentre> centres, const FeatureSpec& spec) {
  FeatureVector features;
  features.centres = static_cast<int>(centres.size());
  features.degenerate = centres.size() < 3;
  if (centres.empty()) return features;
  const auto count = static_cast<double>(centres.size());

  // Weights proportional to amplitude, with sum N_sc.
  double total = 0;
  for (const ScatteringCentre& centre : centres) total += centre.amplitude_m;
  std::vector<double> weight, equal(centres.size(), 1.0);
  for (const ScatteringCentre& centre : centres) weight.push_back(total > 0 ? count * centre.amplitude_m / total : 1);

  const Line line = fit_line(centres, spec.weighted_fit ? weight : equal);
  double mean_r = 0, mean_v = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double residual = centres[i].velocity_mps - (line.slope * centres[i].range_m + line.offset);
    features.mwr += weight[i] * residual * residual / count;
    mean_r += centres[i].range_m / count;
    mean_v += centres[i].velocity_mps / count;
  }
  double variance_r = 0, variance_v = 0;
  for (const ScatteringCentre& centre : centres) {
    variance_r += (centre.range_m - mean_r) * (centre.range_m - mean_r) / count;
    variance_v += (centre.velocity_mps - mean_v) * (centre.velocity_mps - mean_v) / count;
  }
  features.sigma_r = std::sqrt(variance_r);
  features.sigma_v = std::sqrt(variance_v);
  const double s_r = features.sigma_r / spec.range_scale_m, s_v = features.sigma_v / spec.velocity_scale_mps;
  features.ccf = std::abs((s_r - s_v) / (s_r + s_v + kCcfGuard));
  return features;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/look_features.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/core/numbers/dense.h"
#include "sim/core/numbers/real_functions.h"

namespace seaglint {

namespace {

constexpr double kLargestDeviation = 1e6;

double deviation(const ChiSquare& test) {
  if (!test.defined()) return kUndefinedLookFeature;
  const double root = std::sqrt(test.ratio());
  return root < kLargestDeviation ? root : kLargestDeviation;
}

void set_shares(const TrackSet& set, LookFeatures& features) {
  const std::size_t looks = set.time_s.size(), tracks = set.tracks.size();
  Matrix<double> about(looks, tracks);
  for (const VelocityResidual& entry : rank_residuals(set, 0)) about(entry.look, entry.track) = entry.value_mps;
  std::vector<double> residual(tracks), spread(tracks), shares;
  for (const VelocityResidual& entry : rank_residuals(set, 2, FitWeights::kHuber)) {
    residual[entry.track] += entry.value_mps * entry.value_mps;
    spread[entry.track] += about(entry.look, entry.track) * about(entry.look, entry.track);
  }
  for (std::size_t j = 0; j < tracks; ++j)
    if (spread[j] > 0) shares.push_back(std::min(std::sqrt(residual[j] / spread[j]), kLargestDeviation));
  if (shares.size() < kTracksOfShares) return;
  std::ranges::sort(shares);
  features.share_lower_quartile = quantile(shares, 0.25);
  features.share_median = quantile(shares, 0.5);
  features.share_upper_quartile = quantile(shares, 0.75);
}

void set_tempo(const TrackSet& set, LookFeatures& features) {
  const std::vector<VelocityResidual> about = rank_residuals(set, 0);
  std::vector<double> sizes, rates;
  for (std::size_t i = 0; i < about.size(); ++i) {
    sizes.push_back(std::abs(about[i].value_mps));
    if (i == 0 || about[i].track != about[i - 1].track || about[i].look != about[i - 1].look + 1) continue;
    rates.push_back(std::abs(about[i].value_mps - about[i - 1].value_mps) /
                    (set.time_s[about[i].look] - set.time_s[about[i - 1].look]));
  }
  if (rates.empty()) return;
  std::ranges::sort(sizes);
  std::ranges::sort(rates);
  const double size = quantile(sizes, 0.5);
  if (size > 0) features.tempo_per_s = std::min(quantile(rates, 0.5) / size, kLargestDeviation);
}

}  // namespace

LookFeatures look_features(const TrackSet& set) {
  constexpr double kLeastLog10P = -300;
  LookFeatures features;
  for (int rank = 0; rank <= 3; ++rank)
    features.rank_deviation[static_cast<std::size_t>(rank)] = deviation(rank_test(set, rank));
  const ChiSquare rigid = fit_rigid_body(set).test;
  features.rigid_deviation = deviation(rigid);
  features.rigid_log10_p = std::max(kLeastLog10P, std::log10(rigid.p_value()));
  set_shares(set, features);
  set_tempo(set, features);
  features.tracks = static_cast<double>(set.tracks.size());
  for (const Track& track : set.tracks)
    features.seen_fraction += track.looks_seen() / (features.tracks * static_cast<double>(set.time_s.size()));
  return features;
}

std::array<double, kLookFeatureNames.size()> look_feature_values(const LookFeatures& features) {
  return {features.rank_deviation[0],
          features.rank_deviation[1],
          features.rank_deviation[2],
          features.rank_deviation[3],
          features.rigid_deviation,
          features.rigid_log10_p,
          features.share_lower_quartile,
          features.share_median,
          features.share_upper_quartile,
          features.tempo_per_s,
          features.tracks,
          features.seen_fraction};
}

}  // namespace seaglint

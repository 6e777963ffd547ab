// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Features of a sequence of looks: how its tracks move together.

#include <array>
#include <cstddef>

#include "classify/features/rigidity.h"
#include "classify/features/tracks.h"

namespace seaglint {

// Value of a feature that the tracks do not define.
inline constexpr double kUndefinedLookFeature = -1;
// The least number of tracks for shares.
inline constexpr std::size_t kTracksOfShares = 6;

// Features of a sequence of looks, all finite.
struct LookFeatures {
  // Roots of ChiSquare::ratio() of ranks 0 to 3, and of the rigid body; at most 1e6.
  std::array<double, 4> rank_deviation{};
  double rigid_deviation = kUndefinedLookFeature;
  // log10 of ChiSquare::p_value() of the rigid body, at least -300; 0 where not defined.
  double rigid_log10_p = 0;
  // Per track: root mean square residual of the fit of rank 2, of robust weights (FitWeights::kHuber), over that of its
  // velocities about the common ones. Quartiles and median over tracks.
  double share_lower_quartile = kUndefinedLookFeature;
  double share_median = kUndefinedLookFeature;
  double share_upper_quartile = kUndefinedLookFeature;
  // Mean angular frequency of the velocities about the common ones (Rice 1944: root of the ratio of spectral moments):
  // median of |difference of successive looks| / dt over median of |velocity|, rad/s. Errors raise it: it saturates
  // at sqrt(2) / dt where velocities are below their errors.
  double tempo_per_s = kUndefinedLookFeature;
  double tracks = 0;
  double seen_fraction = 0;  // mean over tracks; 0 without tracks
};
LookFeatures look_features(const TrackSet& set);

// Group `looks`, in the order of look_feature_values().
inline constexpr std::array kLookFeatureNames = {"rank0_deviation",      "rank1_deviation", "rank2_deviation",
                                                 "rank3_deviation",      "rigid_deviation", "rigid_log10_p",
                                                 "share_lower_quartile", "share_median",    "share_upper_quartile",
                                                 "tempo_per_s",          "tracks",          "seen_fraction"};
std::array<double, kLookFeatureNames.size()> look_feature_values(const LookFeatures& features);

}  // namespace seaglint

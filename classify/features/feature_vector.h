// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Features of a map's scattering centres: the hand-made ones of the paper, section III-B (MWR, CCF and the spreads),
// and those of rigidity, by the robust line of velocity over range.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "classify/features/scattering_centres.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

struct FeatureVector {
  double mwr = 0;      // (m/s)^2
  double ccf = 0;      // 0..1
  double sigma_r = 0;  // m
  double sigma_v = 0;  // m/s
  int centres = 0;
  bool degenerate = false;  // fewer than 3 centres: features are defined and finite, but carry little information
};

// README.md. With N_sc centres, weights w_i = N_sc A_i / sum A, and the least-squares line v^ = a r + b
// (unweighted unless spec.weighted_fit; a = 0 for centres at one range):
//   MWR = (1/N_sc) sum w_i (v_i - v^_i)^2      sigma_r, sigma_v standard deviations (divisor N_sc)
//   CCF = |(s_r - s_v) / (s_r + s_v + 1e-6)|   s_r = sigma_r / range_scale_m, s_v = sigma_v / velocity_scale_mps
// Without centres all are 0.
FeatureVector compute_features(std::span<const ScatteringCentre> centres, const FeatureSpec& spec);

// The line of velocity over range on which the scattering centres of an elongated rigid body lie, v = offset + slope r.
// A point x of a rigid body that rotates at w has the range rate r^.v_0 + w.(x cross r^), linear in its place across
// the line of sight and in its height; where both are proportional to range, as along a ship's length, it is linear in
// range.
struct VelocityLine {
  double slope = 0;   // 1/s
  double offset = 0;  // m/s, velocity at range 0

  double residual(const ScatteringCentre& centre) const {
    return centre.velocity_mps - (offset + slope * centre.range_m);
  }
};

// Robust and weighted: slope = weighted median of the slopes of all pairs of centres, weight A_i A_j |r_i - r_j| (Sen
// 1968; Jaeckel 1972), offset = median of v_i - slope r_i with weight A_i. It follows the line of most of the power
// whatever the velocities of the rest. Centres at one range have slope 0; without centres all is 0. Of more than 64
// centres the first 64 count, the strongest of clean_map().
VelocityLine robust_velocity_line(std::span<const ScatteringCentre> centres);

// The line v^ of compute_features(). Without centres all is 0.
VelocityLine least_squares_line(std::span<const ScatteringCentre> centres, const FeatureSpec& spec);

// Features of rigidity beyond the paper's four: what is left of the centres' velocities when the rotation of a rigid
// body is taken out by the robust line. Deviations count by magnitude, so that one centre on a clutter peak, which
// dominates the squares of MWR, does not hide a line. Weights are w_i = A_i / sum A, residuals e_i those of the robust
// line. Without centres all are 0.
struct MotionFeatures {
  // |slope| of the line, 1/s: rotation of the whole, small for bodies that move independently about one mean.
  double rotation_per_s = 0;
  // sum w_i |e_i|, m/s: velocities that no rotation explains; 0 for an elongated rigid body, up to the centres' errors.
  double residual_mps = 0;
  // 1 - sum w_i |e_i| / sum w_i |v_i - weighted median v|, at least 0: the part of the spread that rotation explains,
  // whatever the wave height; 0 without spread.
  double explained = 0;
  // Sum of the weights with |e_i| <= 0.01 m/s: the part of the amplitude that moves as one body within the error of a
  // centre.
  double on_line = 0;
};
MotionFeatures motion_features(std::span<const ScatteringCentre> centres);

inline constexpr std::array kMotionFeatureNames = {"rotation_per_s", "line_residual_mps", "line_explained",
                                                   "line_fraction"};

// Features of many maps, the input of the classifiers.

// Rows of features, row-major; all values finite.
struct FeatureMatrix {
  std::vector<std::string> names;  // one per column
  std::vector<float> values;

  std::size_t columns() const { return names.size(); }
  std::size_t rows() const { return names.empty() ? 0 : values.size() / names.size(); }
  std::span<const float> row(std::size_t i) const { return {values.data() + i * columns(), columns()}; }
};

// The given rows, in the given order.
FeatureMatrix select_rows(const FeatureMatrix& matrix, std::span<const std::size_t> rows);
// Concatenates the columns of both (equal numbers of rows).
FeatureMatrix join_columns(const FeatureMatrix& left, const FeatureMatrix& right);

// Reads the feature columns of embeddings.csv: hand-made features, then embedding and logit of the network. Throws
// InputError naming file and line if it is not a table of these samples.
FeatureMatrix read_embeddings(const std::filesystem::path& file, std::span<const std::int64_t> samples);

}  // namespace seaglint

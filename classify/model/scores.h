// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scores of predictions, with confidence intervals that account for the dependence of maps of one sea.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace seaglint {

// One prediction of one test row.
struct Prediction {
  std::int64_t sample = 0;
  std::int64_t group = 0;
  double wave_height_m = 0;
  int label = 0;           // the truth, 1 = ship
  double probability = 0;  // of label 1
};

struct ConfidenceInterval {
  double low = 0;
  double high = 0;
};

struct Scores {
  std::size_t rows = 0;
  std::size_t groups = 0;
  double accuracy = 0;  // at probability 0.5; NaN without rows
  ConfidenceInterval
      accuracy_95;  // percentile bootstrap over groups (Davison and Hinkley 1997, section 5.3); NaN below two groups
  double auc = 0;   // area under the ROC = P(ship scores above array), ties count half; NaN when a class is missing
  double log_loss = 0;  // mean -log of the probability given to the truth, clipped at 1e-7
  std::array<std::array<std::size_t, 2>, 2> confusion{};  // [truth][decision]
};

struct WaveHeightScores {
  double wave_height_m = 0;
  Scores scores;
};

// Stream kBootstrap of (seed, bootstrap_index).
Scores score(std::span<const Prediction> predictions, int bootstrap_samples, std::uint64_t seed,
             std::uint64_t bootstrap_index);

// The same per wave height, ascending.
std::vector<WaveHeightScores> score_by_wave_height(std::span<const Prediction> predictions, int bootstrap_samples,
                                                   std::uint64_t seed, std::uint64_t bootstrap_index);

}  // namespace seaglint

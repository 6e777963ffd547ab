// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Studies with known scores for tests of what is stated of them.

#include <utility>
#include <vector>

#include "classify/model/study.h"

namespace seaglint {

inline Scores scores_of(double accuracy, double half = 0.02) {
  Scores scores;
  scores.rows = 1000;
  scores.groups = 50;
  scores.accuracy = accuracy;
  scores.accuracy_95 = {accuracy - half, accuracy + half};
  scores.confusion = {{480, 20}, {20, 480}};
  return scores;
}

// Bins of the wave heights 0.1, 1 and 2 m, as many as there are accuracies; all maps have their mean.
inline Evaluation evaluation_of(const std::vector<double>& by_height, double half = 0.02) {
  Evaluation evaluation;
  double sum = 0;
  const char* const heights[] = {"0.1", "1", "2"};
  for (std::size_t i = 0; i < by_height.size(); ++i) {
    evaluation.by_wave_height.push_back({heights[i], 0, 0, 0, scores_of(by_height[i], half)});
    sum += by_height[i];
  }
  evaluation.scores = scores_of(sum / static_cast<double>(by_height.size()), half);
  return evaluation;
}

// Both protocols: the random one has 99 % throughout. `linear`: of logistic regression on all features.
inline Study study_of(const std::vector<double>& handmade, const std::vector<double>& network,
                      const std::vector<double>& fused, const std::vector<double>& linear, double order_probe = 0.5) {
  Study study;
  for (const auto& [name, values] : {std::pair{"handmade", handmade}, {"cnn", network}, {"fused", fused}}) {
    FeatureGroupResult group;
    group.name = name;
    const Evaluation random = evaluation_of(std::vector<double>(values.size(), 0.99));
    group.outcomes = {{Protocol::kRandom, random, {}, random, {}, {}, {}},
                      {Protocol::kGroup, evaluation_of(values), {}, evaluation_of(linear), {}, {}, {}}};
    study.groups.push_back(group);
  }
  const Evaluation chance = evaluation_of({0.5});
  study.probes = {{"sample order", ProbeKind::kBlind, "", {chance, evaluation_of({order_probe})}},
                  {"sigma_r alone", ProbeKind::kFeature, "", {chance, chance}},
                  {"MWR alone", ProbeKind::kFeature, "", {chance, evaluation_of({0.97})}}};
  return study;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a study found, in two sentences: how well unseen maps are told apart, and which quantity does so by itself. The
// comparisons of accuracies with guessing on which they rest.

#include <string>

#include "classify/model/study.h"
#include "tools/report/report_data.h"

namespace seaglint {

// Accuracies from the class frequencies alone: in proportion to them, and by always naming the largest class.
struct Guessing {
  double least = 0.5, most = 0.5;

  std::string text() const;  // "50.0 %", "52.0 to 60.0 %"
};
Guessing guessing(const Scores& scores);

// The probe's accuracies are compatible with guessing under all protocols that the study has. Of a probe that is random
// by construction and so independent from map to map: 99 % binomial interval of one split's rows (repeats reuse the
// same maps). Of any other: its bootstrap interval over seas; below guessing it does not tell either, as what it learnt
// does not hold on unseen rows.
bool as_chance(const ProbeResult& probe, int repeats);

std::string capital(std::string text);  // with a capital first letter

// What a probe's quantity depends on: "level", "the ratio of target to clutter", "geometry", "motion", "geometry and
// motion"; of a blind one "nothing of the target".
const char* cause(const ProbeResult& probe);

// Those of clutter and noise whose level does not follow the target's, "The clutter is" or "Clutter and receiver noise
// are"; empty if both do. The target's level then determines which of its centres exceed the threshold, and so affects
// the features.
std::string not_scaled(const ClutterSpec& clutter);

// "On unseen seas the fused features tell ship and array apart in 99.3 % (98–100) of the maps; guessing reaches 50.0 %.
// Geometry alone does as well: number of centres reaches 99.8 % (99–100)." A quantity alone does as well if its 95 %
// interval reaches that of the fused features; level counts where features depend on it (not_scaled()). A blind probe
// away from chance is named in place of it. Plain text.
std::string finding(const Study& study, const Scenario& scenario);

}  // namespace seaglint

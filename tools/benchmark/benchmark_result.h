// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a benchmark states: accuracies of the baselines on unseen seas, of quantities other than motion, and the claims
// of the paper on this data set.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "classify/model/study.h"
#include "tools/benchmark/simultaneous.h"

namespace seaglint {

// A quantity other than motion, classified alone on unseen seas.
struct FloorEntry {
  std::string name;
  Scores scores;       // accuracy_95: Holm's interval over all entries; NaN with one sea
  bool leaks = false;  // Holm's procedure rejects chance
};

// All probes of a study but the features of motion (MWR, CCF, sigma_v). Chance is 1 / number of classes.
std::vector<FloorEntry> floor_of(const Study& study);

enum class Verdict { kHeld, kNotHeld, kUndecided };

// A claim of the paper on this data set.
struct Claim {
  std::string text;
  Verdict verdict = Verdict::kUndecided;  // undecided: the intervals of 95 % overlap
  std::string why;                        // the figures
  std::string meaning;                    // what the verdict follows from, a sentence
};

// Intervals and differences by Student's distribution (simultaneous.h), the floor by Holm's procedure, which can reject
// chance but not prove it. In this order: hand-made features above 86 %; both together no worse than either; hand-made
// features rise with the wave height; trees no worse than logistic regression; motion alone separates the classes.
std::vector<Claim> claims_of(const Study& study);

// Members `baselines` and `floor` (name -> accuracy, interval, by wave height) and `claims`. Fractions; null where
// undefined.
nlohmann::ordered_json benchmark_json(const Study& study);

// The same as a table for the terminal, and as a row of scenarios/README.md.
std::string benchmark_text(const Study& study);
std::string benchmark_row(const std::string& name, std::size_t maps, std::size_t seas, const Study& study);

}  // namespace seaglint

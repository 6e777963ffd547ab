// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Applies a trained model to data sets and writes the evaluation.

#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "tools/evaluate/model_evaluation.h"

namespace seaglint {

inline constexpr const char* kEvaluationFile = "evaluation.json";
inline constexpr const char* kProbabilitiesFile = "probabilities.csv";

struct EvaluatedModel {
  std::string text;                   // for the terminal
  std::string json;                   // content of evaluation.json
  std::vector<std::string> warnings;  // data_set_warnings()
};

// Opens model and data sets, evaluates, and writes evaluation.json and probabilities.csv if an output is given. Throws
// InputError when the model does not fit the data (other grid, settings, classes or version), a data set is given
// twice, a map has a fault, a column is unknown, or no map is left to evaluate; WorkError when a file cannot be
// written; Interrupted when *stop becomes true. The result depends on model and data only.
EvaluatedModel evaluate_model(const EvaluateRequest& request, const StopFlag* stop = nullptr);

}  // namespace seaglint

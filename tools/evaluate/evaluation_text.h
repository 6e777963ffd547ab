// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Outputs of an evaluation: table for the terminal, evaluation.json, probabilities.csv.

#include <span>
#include <string>
#include <vector>

#include "classify/dataset/format/manifest.h"
#include "tools/evaluate/model_evaluation.h"

namespace seaglint {

std::string evaluation_table(const ModelEvaluation& evaluation, const SavedModel& model,
                             const EvaluateRequest& request);

// `manifests`: of the data sets in their order. Undefined values are null.
std::string evaluation_json(const ModelEvaluation& evaluation, const SavedModel& model, const EvaluateRequest& request,
                            std::span<const Manifest> manifests);

// One line per map: data set, sample, sea, conditions, features, probabilities (probability_columns()), use in the
// training (none, sea_seen, trained), whether it was evaluated, names of features and conditions outside the training
// range.
std::string probabilities_csv(const ModelEvaluation& evaluation, const std::vector<std::string>& classes);

const char* name(TrainingUse use);  // "none", "sea_seen", "trained"

}  // namespace seaglint

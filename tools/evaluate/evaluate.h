// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Applies a trained model to data sets: scores in total and by column, calibration, maps outside the training range; as
// a table, JSON and CSV.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"

namespace seaglint {

struct EvaluateRequest {
  std::filesystem::path model;
  std::vector<std::filesystem::path> data_sets;
  std::vector<std::string> by;   // columns in addition to those that are always scored
  std::filesystem::path output;  // directory; empty: no files
  bool trained_rows = false;     // evaluate also the maps that the model was fitted to
  bool unseen_seas = false;      // only maps in seas (seed and key) without a training map
};

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

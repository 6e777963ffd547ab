// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Evaluation of a trained model on data sets: scores in total and by column, calibration, maps outside the training
// range; as a table, JSON and CSV.

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "classify/dataset/format/manifest.h"
#include "classify/model/saved_model.h"
#include "classify/model/scores.h"
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

// Use of a map in the training.
enum class TrainingUse { kNone, kSeaSeen, kTrained };

// The rows of one bin of a column with the scores of the classifiers (kModelNames).
struct BinScores {
  ColumnBin bin;
  std::array<Scores, kModels> scores;
};
struct ColumnScores {
  std::string column;
  std::string unit;
  std::vector<BinScores> bins;
};

// Count of maps outside the range of a column over the training maps.
struct OutsideCount {
  ValueRange range;
  std::size_t below = 0, above = 0;
  std::size_t undefined = 0;  // where every training map has a value, or a value where none has
};

// Members with [row] refer to all maps of the data sets in their order.
struct ModelEvaluation {
  AppliedRows applied;
  std::vector<std::int64_t> seas;                 // [row]
  std::vector<TrainingUse> uses;                  // [row]
  std::vector<std::vector<std::string>> outside;  // [row]: names of features and conditions outside the training range
  std::vector<std::size_t> evaluated;             // rows, ascending
  std::array<Scores, kModels> scores;             // of the evaluated rows, as are the following
  std::array<std::vector<std::vector<RocPoint>>, kModels> roc;  // roc_curves(); empty curves when a class is missing
  std::array<Calibration, kModels> calibrations;
  std::vector<ColumnScores> by;
  std::vector<OutsideCount> features, conditions;
  std::size_t feature_rows_outside = 0;    // maps with a feature outside its range
  std::size_t condition_rows_outside = 0;  // maps with a condition outside its range
};

// `applied`: of all maps of the data sets; `uses`: of every row. Throws InputError for an unknown column and when no
// map is left to evaluate. The result depends on the arguments only.
ModelEvaluation evaluate_rows(const SavedModel& model, AppliedRows applied, std::vector<TrainingUse> uses,
                              const EvaluateRequest& request);

// Outputs of an evaluation: table for the terminal, evaluation.json, probabilities.csv.

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

// Applies a trained model to data sets and writes the evaluation.

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

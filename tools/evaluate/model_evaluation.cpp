// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/model_evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "classify/model/study.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

// Random indices of the intervals by column: above those of the totals, a block for each column.
constexpr std::uint64_t kFirstColumnIndex = 1000000;
constexpr std::uint64_t kColumnBlock = 1000000;

// Columns that are always scored, where the evaluated maps have more than one value.
const std::vector<std::string>& usual_columns() {
  static const std::vector<std::string> names{"label",       "target_name",      "significant_wave_height_m",
                                              "azimuth_deg", "scr_peak_cell_db", "data_set"};
  return names;
}

std::vector<Prediction> predictions_of(const ModelEvaluation& evaluation, std::size_t model,
                                       const std::vector<std::size_t>& rows) {
  std::vector<Prediction> predictions;
  predictions.reserve(rows.size());
  for (const std::size_t row : rows) {
    const SampleRecord& record = evaluation.applied.rows[row].record;
    predictions.push_back(prediction_of(row, evaluation.seas[row], static_cast<int>(record.label),
                                        evaluation.applied.outputs(model, row)));
  }
  return predictions;
}

// Comparisons that are no columns of a data set.
constexpr const char* kTrainingRange = "training_range";
constexpr const char* kSeaOfTraining = "sea_of_training";

// Index of the first interval of a column, whichever columns are scored with it.
std::uint64_t first_index(const std::string& name) {
  std::uint64_t place = 0;
  for (const std::string other : {kTrainingRange, kSeaOfTraining, "data_set", "sea"}) {
    if (other == name) return kFirstColumnIndex + kColumnBlock * place;
    ++place;
  }
  for (const SampleColumn& column : sample_columns()) {
    if (column.name == name) break;
    ++place;
  }
  return kFirstColumnIndex + kColumnBlock * place;
}

// Scores of bins whose rows are counted among the evaluated ones.
ColumnScores column_scores(const ModelEvaluation& evaluation, const SavedModel& model, const std::string& name,
                           const std::string& unit, const std::vector<ColumnBin>& bins) {
  ColumnScores result{name, unit, {}};
  std::uint64_t index = first_index(name);
  for (const ColumnBin& bin : bins) {
    BinScores scored{bin, {}};
    for (std::size_t& row : scored.bin.rows) row = evaluation.evaluated[row];
    for (std::size_t i = 0; i < kModelNames.size(); ++i) {
      scored.scores[i] =
          score(predictions_of(evaluation, i, scored.bin.rows), model.spec.bootstrap_samples, model.card.seed, index++);
    }
    result.bins.push_back(std::move(scored));
  }
  return result;
}

// Evaluated rows with and without a property, as two bins; empty when all are alike.
std::vector<ColumnBin> two_bins(const ModelEvaluation& evaluation, const std::string& with, const std::string& without,
                                const std::function<bool(std::size_t row)>& has) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::vector<ColumnBin> bins{{without, kNan, kNan, kNan, {}}, {with, kNan, kNan, kNan, {}}};
  for (std::size_t i = 0; i < evaluation.evaluated.size(); ++i)
    bins[has(evaluation.evaluated[i]) ? 1 : 0].rows.push_back(i);
  if (bins[0].rows.empty() || bins[1].rows.empty()) bins.clear();
  return bins;
}

void score_columns(ModelEvaluation& evaluation, const SavedModel& model, const std::vector<std::string>& more) {
  std::vector<DataRow> rows;
  for (const std::size_t row : evaluation.evaluated) rows.push_back(evaluation.applied.rows[row]);
  const auto add = [&](const std::string& name, const std::string& unit, const std::vector<ColumnBin>& bins,
                       std::size_t least) {
    if (bins.size() >= least) evaluation.by.push_back(column_scores(evaluation, model, name, unit, bins));
  };
  for (const std::string& name : usual_columns()) {
    const Condition condition = condition_of(rows, name);
    add(name, condition.unit, condition.bins, 2);
  }
  const auto is_outside = [&](std::size_t row) { return !evaluation.outside[row].empty(); };
  add(kTrainingRange, "", two_bins(evaluation, "outside", "inside", is_outside), 2);
  const auto is_seen = [&](std::size_t row) { return evaluation.uses[row] != TrainingUse::kNone; };
  add(kSeaOfTraining, "", two_bins(evaluation, "seen", "unseen", is_seen), 2);
  for (const std::string& name : more) {
    const Condition condition = condition_of(rows, name);
    const bool is_scored = std::any_of(evaluation.by.begin(), evaluation.by.end(),
                                       [&](const ColumnScores& scores) { return scores.column == name; });
    if (!is_scored) add(name, condition.unit, condition.bins, 1);
  }
}

// Counts the evaluated rows outside each range, and records the columns' names at every row.
std::vector<OutsideCount> count_outside(ModelEvaluation& evaluation, const std::vector<ValueRange>& ranges,
                                        std::size_t& rows_outside) {
  std::vector<OutsideCount> counts;
  std::vector<bool> is_evaluated(evaluation.applied.rows.size()), any(evaluation.applied.rows.size());
  for (const std::size_t row : evaluation.evaluated) is_evaluated[row] = true;
  for (const ValueRange& range : ranges) {
    OutsideCount count{range};
    const ColumnOfRows column = column_of(evaluation.applied.rows, range.name);
    for (std::size_t row = 0; row < column.numbers.size(); ++row) {
      const double value = column.numbers[row];
      if (!range.excludes(value)) continue;
      evaluation.outside[row].push_back(range.name);
      any[row] = true;
      if (!is_evaluated[row]) continue;
      if (value < range.lowest) {
        ++count.below;
      } else if (value > range.highest) {
        ++count.above;
      } else {
        ++count.undefined;
      }
    }
    counts.push_back(count);
  }
  rows_outside = 0;
  for (const std::size_t row : evaluation.evaluated) rows_outside += any[row] ? 1 : 0;
  return counts;
}

}  // namespace

ModelEvaluation evaluate_rows(const SavedModel& model, AppliedRows applied, std::vector<TrainingUse> uses,
                              const EvaluateRequest& request) {
  ModelEvaluation evaluation;
  evaluation.applied = std::move(applied);
  evaluation.seas = sea_numbers(evaluation.applied.rows);
  evaluation.uses = std::move(uses);
  evaluation.outside.resize(evaluation.applied.rows.size());
  for (std::size_t row = 0; row < evaluation.applied.rows.size(); ++row) {
    const TrainingUse use = evaluation.uses[row];
    if (use == TrainingUse::kTrained && !request.trained_rows) continue;
    if (use != TrainingUse::kNone && request.unseen_seas) continue;
    evaluation.evaluated.push_back(row);
  }
  if (evaluation.evaluated.empty()) {
    throw InputError(fmt::format("none of {} maps is left to evaluate: the model was fitted to them{}",
                                 evaluation.applied.rows.size(),
                                 request.unseen_seas ? " or to maps of their seas" : "; --trained-rows includes them"));
  }
  evaluation.features = count_outside(evaluation, model.card.feature_ranges, evaluation.feature_rows_outside);
  evaluation.conditions = count_outside(evaluation, model.card.condition_ranges, evaluation.condition_rows_outside);
  for (std::size_t i = 0; i < kModelNames.size(); ++i) {
    const std::vector<Prediction> predictions = predictions_of(evaluation, i, evaluation.evaluated);
    evaluation.scores[i] =
        score(predictions, model.spec.bootstrap_samples, model.card.seed, bootstrap_index(i, Protocol::kGroup));
    evaluation.roc[i] = roc_curves(predictions);
    evaluation.calibrations[i] = calibration(predictions);
  }
  score_columns(evaluation, model, request.by);
  return evaluation;
}

}  // namespace seaglint

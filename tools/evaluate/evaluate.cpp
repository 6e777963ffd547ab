// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/evaluate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/manifest.h"
#include "classify/model/saved_model.h"
#include "classify/model/scores.h"
#include "classify/model/study.h"
#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/process/progress.h"
#include "sim/core/text/json.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

using nlohmann::ordered_json;

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

// `applied`: of all maps of the data sets; `uses`: of every row. Throws InputError for an unknown column and when no
// map is left to evaluate.
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

constexpr std::array<const char*, kModels> kTitles{"hand-made", "CNN", "fused", "extended"};

std::string row_of(const std::string& what, const std::array<Scores, kModels>& scores) {
  std::string line = fmt::format("  {:<24}{:>7}{:>6}", what, scores[0].rows, scores[0].groups);
  for (const Scores& each : scores) line += fmt::format("{:>18}", percent(each));
  return line + "\n";
}

std::string numbers_of(const char* what, const std::array<double, kModels>& values) {
  std::string line = fmt::format("  {:<37}", what);
  for (const double value : values)
    line += fmt::format("{:>18}", std::isfinite(value) ? fmt::format("{:.3f}", value) : "-");
  return line + "\n";
}

// "mwr, (m/s)^2: 2 below 0.001, 3 above 0.02"
std::string outside_text(const OutsideCount& count) {
  std::vector<std::string> parts;
  if (count.below > 0) parts.push_back(fmt::format("{} below {:.4g}", count.below, count.range.lowest));
  if (count.above > 0) parts.push_back(fmt::format("{} above {:.4g}", count.above, count.range.highest));
  if (count.undefined > 0)
    parts.push_back(fmt::format("{} {}", count.undefined, count.range.has_undefined ? "defined" : "undefined"));
  const std::string unit = count.range.unit == "1" ? "" : ", " + count.range.unit;
  return fmt::format("    {}{}: {}\n", count.range.name, unit, fmt::join(parts, ", "));
}

std::string outside_table(const std::vector<OutsideCount>& counts, std::size_t rows, std::size_t all,
                          const char* what) {
  std::string text = fmt::format("  {} of {} maps with a {} outside\n", rows, all, what);
  for (const OutsideCount& count : counts)
    if (count.below + count.above + count.undefined > 0) text += outside_text(count);
  return text;
}

// `name`: of the fraction of label 1, or of right decisions.
ordered_json to_object(const Calibration& calibration, const char* name) {
  ordered_json json{{"expected_error", number_or_null(calibration.expected_error)}, {"bins", ordered_json::array()}};
  for (const CalibrationBin& bin : calibration.bins) {
    json["bins"].push_back({{"lowest", bin.lowest},
                            {"rows", bin.rows},
                            {"mean_probability", number_or_null(bin.mean_probability)},
                            {name, number_or_null(bin.fraction)}});
  }
  return json;
}

ordered_json to_array(const std::vector<OutsideCount>& counts) {
  ordered_json json = ordered_json::array();
  for (const OutsideCount& count : counts) {
    json.push_back({{"name", count.range.name},
                    {"units", count.range.unit},
                    {"lowest", number_or_null(count.range.lowest)},
                    {"highest", number_or_null(count.range.highest)},
                    {"below", count.below},
                    {"above", count.above},
                    {"undefined", count.undefined}});
  }
  return json;
}

std::size_t count_of(const ModelEvaluation& evaluation, TrainingUse use) {
  return static_cast<std::size_t>(std::count(evaluation.uses.begin(), evaluation.uses.end(), use));
}

const char* name(TrainingUse use) {
  constexpr const char* kNames[] = {"none", "sea_seen", "trained"};
  return kNames[static_cast<int>(use)];
}

std::string evaluation_table(const ModelEvaluation& evaluation, const SavedModel& model,
                             const EvaluateRequest& request) {
  const std::size_t all = evaluation.applied.rows.size(), rows = evaluation.evaluated.size();
  std::string text =
      fmt::format("{}: fitted to {} maps of {} data set{}; {}\n", request.model.string(), model.card.train_rows,
                  model.card.data_sets.size(), model.card.data_sets.size() == 1 ? "" : "s", model.card.division);
  for (std::size_t i = 0; i < request.data_sets.size(); ++i)
    text += fmt::format("data set {}: {}\n", i, request.data_sets[i].string());
  text +=
      fmt::format("{} of {} maps evaluated; the model was fitted to {}{}, {} more are in seas of the training{}\n\n",
                  rows, all, count_of(evaluation, TrainingUse::kTrained), request.trained_rows ? "" : " (left out)",
                  count_of(evaluation, TrainingUse::kSeaSeen), request.unseen_seas ? " (left out)" : "");
  text += "Accuracy in % (95 % interval by bootstrap over seas)\n\n";
  text += fmt::format("  {:<24}{:>7}{:>6}", "", "maps", "seas");
  for (const char* title : kTitles) text += fmt::format("{:>18}", title);
  text += "\n";
  text += row_of("all", evaluation.scores);
  for (const ColumnScores& column : evaluation.by) {
    text += fmt::format("{}{}\n", column.column,
                        column.unit.empty() || column.unit == "1" ? "" : fmt::format(" ({})", column.unit));
    for (const BinScores& bin : column.bins) {
      std::string what = bin.bin.text;
      if (column.column == "label") what = model.card.classes[static_cast<std::size_t>(bin.bin.lowest)];
      text += row_of(what, bin.scores);
    }
  }
  std::array<double, kModels> auc{}, error{}, loss{};
  for (std::size_t i = 0; i < auc.size(); ++i) {
    auc[i] = evaluation.scores[i].auc;
    error[i] = evaluation.calibrations[i].expected_error;
    loss[i] = evaluation.scores[i].log_loss;
  }
  text += "\n";
  const bool two = model.card.classes.size() == 2;
  text += numbers_of(two ? "area under the ROC" : "area under the ROC, mean over pairs", auc);
  text += numbers_of("expected calibration error", error);
  text += numbers_of("log loss", loss);
  const std::size_t classes = model.card.classes.size();
  for (std::size_t truth = 0; truth < classes; ++truth) {
    for (std::size_t decision = 0; decision < classes; ++decision) {
      text += fmt::format("  {:<37}",
                          fmt::format("{} declared {}", model.card.classes[truth], model.card.classes[decision]));
      for (const Scores& scores : evaluation.scores) text += fmt::format("{:>18}", scores.confusion[truth][decision]);
      text += "\n";
    }
  }
  text += "\nTraining range\n";
  text += outside_table(evaluation.features, evaluation.feature_rows_outside, rows, "feature");
  text += outside_table(evaluation.conditions, evaluation.condition_rows_outside, rows, "condition");
  return text;
}

// `manifests`: of the data sets in their order. Undefined values are null.
std::string evaluation_json(const ModelEvaluation& evaluation, const SavedModel& model, const EvaluateRequest& request,
                            std::span<const Manifest> manifests) {
  ordered_json json;
  json["program_version"] = kVersion;
  json["model"] = {{"seed", model.card.seed},
                   {"features", model.card.features},
                   {"division", model.card.division},
                   {"train_rows", model.card.train_rows},
                   {"sha256", model.card.sha256}};
  json["classes"] = model.card.classes;
  for (const Manifest& manifest : manifests) {
    json["data_sets"].push_back({{"scenario", manifest.scenario},
                                 {"scenario_sha256", manifest.scenario_sha256},
                                 {"seed", manifest.seed},
                                 {"maps", manifest.samples}});
  }
  json["maps"] = {{"all", evaluation.applied.rows.size()},
                  {"evaluated", evaluation.evaluated.size()},
                  {"trained", count_of(evaluation, TrainingUse::kTrained)},
                  {"sea_seen", count_of(evaluation, TrainingUse::kSeaSeen)},
                  {"trained_rows", request.trained_rows},
                  {"unseen_seas", request.unseen_seas}};
  for (std::size_t i = 0; i < kModelNames.size(); ++i) {
    ordered_json& entry = json[kModelNames[i]];
    entry = to_object(evaluation.scores[i], model.card.classes);
    entry["calibration"] = to_object(evaluation.calibrations[i], model.card.classes.size() == 2 ? "ships" : "right");
    entry["roc"] = to_object(evaluation.roc[i], model.card.classes);
  }
  json["by"] = ordered_json::array();
  for (const ColumnScores& column : evaluation.by) {
    ordered_json entry{{"column", column.column}, {"units", column.unit}, {"bins", ordered_json::array()}};
    for (const BinScores& scored : column.bins) {
      ordered_json bin{{"value", scored.bin.text},
                       {"lowest", number_or_null(scored.bin.lowest)},
                       {"highest", number_or_null(scored.bin.highest)}};
      for (std::size_t i = 0; i < kModelNames.size(); ++i)
        bin[kModelNames[i]] = to_object(scored.scores[i], model.card.classes);
      entry["bins"].push_back(std::move(bin));
    }
    json["by"].push_back(std::move(entry));
  }
  json["outside"] = {{"maps_by_feature", evaluation.feature_rows_outside},
                     {"maps_by_condition", evaluation.condition_rows_outside},
                     {"features", to_array(evaluation.features)},
                     {"conditions", to_array(evaluation.conditions)}};
  return json.dump(2) + "\n";
}

// One line per map: data set, sample, sea, conditions, features, probabilities (probability_columns()), use in the
// training, whether it was evaluated, names of features and conditions outside the training range.
std::string probabilities_csv(const ModelEvaluation& evaluation, const std::vector<std::string>& classes) {
  std::string text = "data_set,sample,sea,label,target_name,significant_wave_height_m,azimuth_deg,scr_peak_cell_db";
  for (const std::string& feature : evaluation.applied.features.names) text += "," + feature;
  for (const char* model : kModelNames) text += fmt::format(",{}", fmt::join(probability_columns(model, classes), ","));
  text += ",training,evaluated,outside\n";
  std::vector<bool> is_evaluated(evaluation.applied.rows.size());
  for (const std::size_t row : evaluation.evaluated) is_evaluated[row] = true;
  const auto number_cell = [](double value) { return std::isnan(value) ? std::string() : fmt::format("{}", value); };
  for (std::size_t row = 0; row < evaluation.applied.rows.size(); ++row) {
    const DataRow& data = evaluation.applied.rows[row];
    text += fmt::format("{},{},{},{},{},{},{},{}", data.data_set, data.record.sample, evaluation.seas[row],
                        data.record.label, csv_cell(data.record.target_name),
                        number_cell(data.record.significant_wave_height_m), number_cell(data.record.azimuth_deg),
                        number_cell(data.record.scr_peak_cell_db));
    for (const float value : evaluation.applied.features.row(row)) text += fmt::format(",{}", value);
    for (std::size_t model = 0; model < kModelNames.size(); ++model)
      text += fmt::format(",{}", fmt::join(evaluation.applied.outputs(model, row), ","));
    text += fmt::format(",{},{},{}\n", name(evaluation.uses[row]), is_evaluated[row] ? 1 : 0,
                        fmt::join(evaluation.outside[row], " "));
  }
  return text;
}

// Throws InputError for a directory of a data set or model, WorkError where nothing can be written.
void require_output(const fs::path& directory) {
  if (directory.empty()) return;
  if (fs::exists(directory) && !fs::is_directory(directory))
    throw InputError(fmt::format("{}: is a file, not a directory", directory.string()));
  for (const char* file : {kScenarioFile, kManifestFile, kModelFile}) {
    if (fs::exists(directory / file))
      throw InputError(fmt::format("{}: is the directory of a data set, run or model", directory.string()));
  }
  fs::path there = directory;
  while (!fs::exists(there) && there.has_relative_path()) there = there.parent_path();
  require_writable((there.empty() ? fs::path(".") : there) / kEvaluationFile);
}

}  // namespace

EvaluatedModel evaluate_model(const EvaluateRequest& request, const StopFlag* stop) {
  require_output(request.output);
  // Refuses an unknown column before any work; keys that are drawn are known when the rows are.
  for (const std::string& name : request.by)
    if (name.find('.') == std::string::npos) column_of({}, name);
  EvaluatedModel result;
  std::vector<DatasetReader> readers;
  std::map<std::string, std::string> scenarios;
  for (const fs::path& data_set : request.data_sets) {
    readers.emplace_back(data_set);
    const std::vector<std::string> warnings = data_set_warnings(readers.back());
    result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
    const auto [first, is_new] = scenarios.try_emplace(readers.back().manifest().scenario_sha256, data_set.string());
    if (!is_new)
      throw InputError(fmt::format("{}: the same maps as {}: of one scenario", data_set.string(), first->second));
  }
  const SavedModel model = SavedModel::load(request.model, kVersion);
  const TrainedRows trained = read_trained_rows(request.model);

  std::size_t shards = 0;
  for (const DatasetReader& reader : readers) shards += reader.shards();
  AppliedRows applied;
  {
    Progress progress("evaluating shards", shards);
    for (std::size_t i = 0; i < readers.size(); ++i) {
      const Scenario scenario = read_scenario(readers[i].directory() / kScenarioFile);
      for (std::size_t k = 0; k < readers[i].shards(); ++k) {
        if (stop && *stop) throw Interrupted();
        const Shard shard = readers[i].shard(k);
        require_applicable(model.card, readers[i].directory(), scenario, shard.axes);
        apply_model(model, shard, readers[i].directory() / readers[i].manifest().shards[k].file, i, applied);
        progress.advance();
      }
    }
  }

  // Number of each data set among those of the training.
  std::vector<std::optional<std::size_t>> training_set(readers.size());
  for (std::size_t i = 0; i < readers.size(); ++i)
    for (std::size_t k = 0; k < model.card.data_sets.size(); ++k)
      if (readers[i].manifest().scenario_sha256 == model.card.data_sets[k].scenario_sha256) training_set[i] = k;
  std::vector<TrainingUse> uses;
  for (const DataRow& row : applied.rows) {
    const auto& set = training_set[row.data_set];
    const bool is_trained = set && trained.samples.contains({*set, row.record.sample});
    const bool is_seen = trained.seas.contains({row.record.seed, row.record.sea_key});
    uses.push_back(is_trained ? TrainingUse::kTrained : is_seen ? TrainingUse::kSeaSeen : TrainingUse::kNone);
  }

  const ModelEvaluation evaluation = evaluate_rows(model, std::move(applied), std::move(uses), request);
  std::vector<Manifest> manifests;
  for (const DatasetReader& reader : readers) manifests.push_back(reader.manifest());
  result.text = evaluation_table(evaluation, model, request);
  result.json = evaluation_json(evaluation, model, request, manifests);
  if (!request.output.empty()) {
    make_directory(request.output);
    write_file(request.output / kProbabilitiesFile, probabilities_csv(evaluation, model.card.classes));
    write_file(request.output / kEvaluationFile, result.json);
    result.text += fmt::format("\n{}: {}, {}\n", request.output.string(), kEvaluationFile, kProbabilitiesFile);
  }
  return result;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/evaluation_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "classify/model/study_text.h"
#include "seaglint_version.h"
#include "sim/core/text/escape.h"
#include "sim/core/text/json_number.h"

namespace seaglint {

namespace {

using nlohmann::ordered_json;

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

}  // namespace

const char* name(TrainingUse use) {
  switch (use) {
    case TrainingUse::kNone: return "none";
    case TrainingUse::kSeaSeen: return "sea_seen";
    case TrainingUse::kTrained: return "trained";
  }
  return "";
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

}  // namespace seaglint

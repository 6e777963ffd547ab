// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/study_text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/core/text/json_number.h"

namespace seaglint {

namespace {

using nlohmann::ordered_json;

ordered_json to_object(const Evaluation& evaluation) {
  ordered_json json = to_object(evaluation.scores);
  json["train_rows"] = evaluation.train_rows;
  json["by_wave_height"] = ordered_json::array();
  for (const WaveHeightScores& entry : evaluation.by_wave_height) {
    ordered_json row;
    row["significant_wave_height_m"] = entry.wave_height_m;
    row.update(to_object(entry.scores));
    json["by_wave_height"].push_back(row);
  }
  return json;
}

const char* fusion_name(Fusion fusion) { return fusion == Fusion::kSplit ? "split" : "in_sample"; }

}  // namespace

std::string percent(const Scores& scores) {
  if (!std::isfinite(scores.accuracy)) return "-";
  if (!std::isfinite(scores.accuracy_95.low)) return fmt::format("{:.1f}", 100 * scores.accuracy);
  return fmt::format("{:.1f} ({:.0f}-{:.0f})", 100 * scores.accuracy, 100 * scores.accuracy_95.low,
                     100 * scores.accuracy_95.high);
}

ordered_json to_object(const Scores& scores) {
  ordered_json json;
  json["rows"] = scores.rows;
  json["groups"] = scores.groups;
  json["accuracy"] = number_or_null(scores.accuracy);
  json["accuracy_95"] = {number_or_null(scores.accuracy_95.low), number_or_null(scores.accuracy_95.high)};
  json["auc"] = number_or_null(scores.auc);
  json["log_loss"] = number_or_null(scores.log_loss);
  json["confusion"] = {{"array_as_array", scores.confusion[0][0]},
                       {"array_as_ship", scores.confusion[0][1]},
                       {"ship_as_array", scores.confusion[1][0]},
                       {"ship_as_ship", scores.confusion[1][1]}};
  return json;
}

ordered_json to_object(const std::vector<RocPoint>& curve) {
  ordered_json json{{"false_alarms", ordered_json::array()}, {"detections", ordered_json::array()}};
  for (const RocPoint& point : curve) {
    json["false_alarms"].push_back(point.false_alarms);
    json["detections"].push_back(point.detections);
  }
  return json;
}

ordered_json to_json(const Study& study, const LearningSpec& spec) {
  ordered_json json;
  const Fusion other = spec.fusion == Fusion::kSplit ? Fusion::kInSample : Fusion::kSplit;
  for (const FeatureGroupResult& group : study.groups) {
    ordered_json entry;
    entry["columns"] = group.columns;
    entry["gain"] = group.gain;
    const bool network = group.name == "cnn" || group.name == "fused";
    if (network) entry["fusion"] = fusion_name(spec.fusion);
    ordered_json others;
    for (const Outcome& outcome : group.outcomes) {
      entry[name(outcome.protocol)] = to_object(outcome.primary);
      entry[name(outcome.protocol)]["roc"] = to_object(outcome.roc);
      entry[name(outcome.protocol)]["logistic_regression"] = to_object(outcome.linear);
      others[name(outcome.protocol)] = to_object(outcome.alternative);
    }
    entry[network ? fusion_name(other) : "fewer_rows"] = others;
    json[group.name] = entry;
  }
  json["probes"] = ordered_json::array();
  for (const ProbeResult& probe : study.probes) {
    ordered_json entry{{"name", probe.name}, {"kind", name(probe.kind)}, {"meaning", probe.meaning}};
    entry["random"] = to_object(probe.evaluations[0]);
    entry["group"] = to_object(probe.evaluations[1]);
    json["probes"].push_back(entry);
  }
  json["split_repeats"] = spec.split_repeats;
  const TrainingHistory& history = study.network->history();
  json["network"] = {{"parameters", study.network->parameter_count()},
                     {"epochs", history.epochs},
                     {"training_loss", history.fit},
                     {"validation_loss", history.validation}};
  return json;
}

std::string accuracy_table(const Study& study) {
  std::string text = "Accuracy in % (95 % interval by bootstrap over seas), XGBoost on four groups of features\n\n";
  for (std::size_t protocol = 0; protocol < 2; ++protocol) {
    text += protocol == 0 ? "random split of the maps (the paper's protocol)\n" : "\n" + study.division + "\n";
    text += fmt::format("  {:<10}{:>18}{:>18}{:>18}{:>18}\n", "Hs [m]", "hand-made", "CNN", "fused", "extended");
    const auto& heights = study.groups.front().outcomes[protocol].primary.by_wave_height;
    for (std::size_t i = 0; i <= heights.size(); ++i) {
      text += fmt::format("  {:<10}", i < heights.size() ? fmt::format("{:g}", heights[i].wave_height_m) : "all");
      for (const FeatureGroupResult& group : study.groups) {
        const Evaluation& evaluation = group.outcomes[protocol].primary;
        text += fmt::format("{:>18}",
                            percent(i < heights.size() ? evaluation.by_wave_height[i].scores : evaluation.scores));
      }
      text += "\n";
    }
  }
  return text;
}

}  // namespace seaglint

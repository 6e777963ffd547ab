// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/study_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/core/process/error.h"
#include "sim/core/text/json.h"

namespace seaglint {

namespace {

using nlohmann::ordered_json;

ordered_json to_object(const Evaluation& evaluation, const std::vector<std::string>& classes) {
  ordered_json json = to_object(evaluation.scores, classes);
  json["train_rows"] = evaluation.train_rows;
  json["by_wave_height"] = ordered_json::array();
  for (const BinnedScores& entry : evaluation.by_wave_height) {
    ordered_json row{
        {kWaveHeightColumn, entry.mean}, {"bin", entry.text}, {"lowest", entry.lowest}, {"highest", entry.highest}};
    row.update(to_object(entry.scores, classes));
    json["by_wave_height"].push_back(row);
  }
  return json;
}

ordered_json to_object(const ConditionScores& condition, const std::vector<std::string>& classes) {
  ordered_json json{{"column", condition.name}, {"units", condition.unit}, {"bins", ordered_json::array()}};
  for (const BinnedScores& entry : condition.bins) {
    ordered_json row{{"bin", entry.text},
                     {"mean", number_or_null(entry.mean)},
                     {"lowest", number_or_null(entry.lowest)},
                     {"highest", number_or_null(entry.highest)}};
    row.update(to_object(entry.scores, classes));
    json["bins"].push_back(row);
  }
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

const char* fusion_name(Fusion fusion) { return fusion == Fusion::kSplit ? "split" : "in_sample"; }

}  // namespace

std::string percent(const Scores& scores) {
  if (!std::isfinite(scores.accuracy)) return "-";
  if (!std::isfinite(scores.accuracy_95.low)) return fmt::format("{:.1f}", 100 * scores.accuracy);
  return fmt::format("{:.1f} ({:.0f}-{:.0f})", 100 * scores.accuracy, 100 * scores.accuracy_95.low,
                     100 * scores.accuracy_95.high);
}

std::string one_word(std::string class_name) {
  std::ranges::replace(class_name, ' ', '_');
  return class_name;
}

std::vector<std::string> probability_columns(const std::string& model, const std::vector<std::string>& classes) {
  std::vector<std::string> names;
  if (classes.size() == 2) return {"probability_" + model};
  for (const std::string& name : classes) names.push_back(fmt::format("probability_{}_{}", model, one_word(name)));
  return names;
}

ordered_json to_object(const Scores& scores, const std::vector<std::string>& classes) {
  ordered_json json;
  json["rows"] = scores.rows;
  json["groups"] = scores.groups;
  json["accuracy"] = number_or_null(scores.accuracy);
  json["accuracy_95"] = {number_or_null(scores.accuracy_95.low), number_or_null(scores.accuracy_95.high)};
  json["auc"] = number_or_null(scores.auc);
  json["log_loss"] = number_or_null(scores.log_loss);
  SEAGLINT_CHECK(scores.confusion.size() == classes.size(),
                 fmt::format("scores of {} classes, {} names", scores.confusion.size(), classes.size()));
  for (std::size_t truth = 0; truth < classes.size(); ++truth) {
    for (std::size_t decision = 0; decision < classes.size(); ++decision) {
      const std::string name = fmt::format("{}_as_{}", one_word(classes[truth]), one_word(classes[decision]));
      json["confusion"][name] = scores.confusion[truth][decision];
    }
  }
  return json;
}

ordered_json to_object(const std::vector<std::vector<RocPoint>>& curves, const std::vector<std::string>& classes) {
  if (curves.size() == 1) return to_object(curves.front());
  ordered_json json;
  for (std::size_t label = 0; label < curves.size(); ++label) json[one_word(classes[label])] = to_object(curves[label]);
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
      entry[name(outcome.protocol)] = to_object(outcome.primary, study.classes);
      entry[name(outcome.protocol)]["roc"] = to_object(outcome.roc, study.classes);
      for (std::size_t i = 0; group.name == "fused" && i < outcome.primary.by_wave_height.size(); ++i)
        entry[name(outcome.protocol)]["by_wave_height"][i]["roc"] =
            to_object(outcome.primary.by_wave_height[i].roc, study.classes);
      entry[name(outcome.protocol)]["logistic_regression"] = to_object(outcome.linear, study.classes);
      for (const ConditionScores& condition : outcome.by_drawn)
        entry[name(outcome.protocol)]["by_drawn"].push_back(to_object(condition, study.classes));
      if (outcome.alternative) others[name(outcome.protocol)] = to_object(*outcome.alternative, study.classes);
    }
    if (!others.empty()) entry[network ? fusion_name(other) : "fewer_rows"] = others;
    json[group.name] = entry;
  }
  json["probes"] = ordered_json::array();
  for (const ProbeResult& probe : study.probes) {
    ordered_json entry{{"name", probe.name}, {"kind", name(probe.kind)}, {"meaning", probe.meaning}};
    if (probe.evaluations.size() > 1) entry["random"] = to_object(probe.evaluations.front(), study.classes);
    entry["group"] = to_object(probe.of_group(), study.classes);
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
  for (std::size_t protocol = 0; protocol < study.groups.front().outcomes.size(); ++protocol) {
    text += protocol == 0 ? "" : "\n";
    text += study.groups.front().outcomes[protocol].protocol == Protocol::kRandom
                ? "random split of the maps (the paper's protocol)\n"
                : study.division + "\n";
    text += fmt::format("  {:<16}{:>18}{:>18}{:>18}{:>18}\n", "Hs [m]", "hand-made", "CNN", "fused", "extended");
    const auto& heights = study.groups.front().outcomes[protocol].primary.by_wave_height;
    for (std::size_t i = 0; i <= heights.size(); ++i) {
      text += fmt::format("  {:<16}", i < heights.size() ? heights[i].text : "all");
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

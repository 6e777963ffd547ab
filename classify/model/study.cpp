// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/study.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "classify/model/classifiers.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/out_of_memory.h"
#include "sim/core/process/progress.h"
#include "sim/core/text/json.h"

namespace seaglint {

namespace {

constexpr Protocol kProtocols[2] = {Protocol::kRandom, Protocol::kGroup};
constexpr bool kHasNetwork[kModels] = {false, true, true, false};

Fusion other_fusion(Fusion fusion) { return fusion == Fusion::kSplit ? Fusion::kInSample : Fusion::kSplit; }

// Without the network the primary result uses every training row, as `in_sample` does for the trees.
Fusion primary_fusion(std::size_t group, const LearningSpec& spec) {
  return kHasNetwork[group] ? spec.fusion : Fusion::kInSample;
}

std::vector<int> select(const std::vector<int>& labels, const std::vector<std::size_t>& rows) {
  std::vector<int> selected;
  for (const std::size_t row : rows) selected.push_back(labels[row]);
  return selected;
}

// Trees of some rows of a table with these features.
Booster trees_of(const FeatureMatrix& features, const LearningTable& table, const std::vector<std::size_t>& rows,
                 const LearningSpec& spec, const StopFlag* stop) {
  return Booster::train(select_rows(features, rows), select(table.labels, rows), spec, stop, table.classes.size());
}

// One training of network and trees: a repeat of a protocol with one kind of fusion.
struct Job {
  std::uint64_t repeat = 0;
  Protocol protocol = Protocol::kGroup;
  Fusion fusion = Fusion::kSplit;
  std::array<bool, kModels> groups{true, true, true, true};  // of features that are wanted

  bool is_wanted() const { return std::ranges::find(groups, true) != groups.end(); }
  bool has_network() const { return groups[1] || groups[2]; }
};

struct JobResult {
  std::vector<Prediction> predictions[kModels];
  std::vector<Prediction> linear[kModels];  // of logistic regression
  std::size_t train_rows[kModels] = {};
  std::optional<Network> network;
  std::optional<Booster> boosters[kModels];
  FeatureMatrix embeddings;
  Split split;
};

template <class Model>
std::vector<Prediction> predict_rows(const Model& model, const FeatureMatrix& features, const LearningTable& table,
                                     const std::vector<std::size_t>& rows) {
  const std::vector<double> probabilities = model.predict(select_rows(features, rows));
  const std::size_t outputs = outputs_of(table.classes.size());
  SEAGLINT_CHECK(probabilities.size() == outputs * rows.size(), "outputs for every row");
  std::vector<Prediction> predictions;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t row = rows[i];
    predictions.push_back(
        prediction_of(row, table.groups[row].group, table.labels[row], {&probabilities[i * outputs], outputs}));
  }
  return predictions;
}

// Protocol slowest, then main and other fusion, then repeat.
std::vector<Job> all_jobs(const LearningSpec& spec, StudyScope scope = StudyScope::kFull) {
  std::vector<Job> jobs;
  for (const Protocol protocol : kProtocols) {
    for (const Fusion fusion : {spec.fusion, other_fusion(spec.fusion)}) {
      for (int repeat = 0; repeat < spec.split_repeats; ++repeat) {
        jobs.push_back({static_cast<std::uint64_t>(repeat), protocol, fusion});
        if (scope == StudyScope::kFull) continue;
        for (std::size_t group = 0; group < kModels; ++group)
          jobs.back().groups[group] = protocol == Protocol::kGroup && fusion == primary_fusion(group, spec);
      }
    }
  }
  return jobs;
}

// The rows of a job; its scores are those of split.test. Weights of the network are fitted to `fit`; `validation`, of
// other seas under the group protocol, selects its epoch.
struct JobRows {
  Split split;
  std::vector<std::size_t> fit, validation;
  std::vector<std::size_t> trees;
};

JobRows rows_of(const Job& job, const Division& division, const LearningSpec& spec, double train_fraction,
                std::uint64_t seed) {
  JobRows rows;
  rows.split = divide(division, job.protocol, train_fraction, seed, job.repeat);
  Split fusion = split_for_fusion(division.units, rows.split, job.protocol, spec.network_fraction, seed, job.repeat);
  rows.fit = std::move(fusion.train);
  rows.validation = std::move(fusion.test);
  rows.trees = job.fusion == Fusion::kInSample ? rows.split.train : rows.validation;
  if (rows.fit.empty() || rows.validation.empty() || rows.split.test.empty()) {
    const bool by_sea = job.protocol == Protocol::kRandom || division.by == "sea";
    throw InputError(
        fmt::format("dataset: {} maps in too few {} leave nothing to train or to test on when they are split by {}{}",
                    division.units.size(), by_sea ? "seas" : "values of " + division.by,
                    job.protocol == Protocol::kRandom ? "rows"
                    : by_sea                          ? "seas"
                                                      : division.by,
                    by_sea ? "; raise dataset.realisations_per_case" : ""));
  }
  return rows;
}

// With fusion `in_sample` the network is fitted once more, to all training rows, for the number of epochs that the
// validation rows selected.
Network train_network(const Job& job, const JobRows& rows, const LearningTable& table, const LearningSpec& spec,
                      std::uint64_t seed, const StopFlag* stop) {
  const std::uint64_t index =
      (job.repeat * 2 + (job.protocol == Protocol::kGroup ? 1 : 0)) * 2 + (job.fusion == Fusion::kSplit ? 0 : 1);
  const std::size_t classes = table.classes.size();
  Network network =
      Network::train(table.centres, {rows.fit, rows.validation}, table.labels, spec, seed, index, stop, classes);
  if (job.fusion == Fusion::kSplit) return network;
  LearningSpec as_selected = spec;
  as_selected.epochs = network.history().epochs;
  return Network::train(table.centres, {rows.split.train, {}}, table.labels, as_selected, seed, index, stop, classes);
}

JobResult run_job(const Job& job, const LearningTable& table, const LearningSpec& spec, double train_fraction,
                  std::uint64_t seed, const StopFlag* stop) {
  JobResult result;
  const JobRows rows = rows_of(job, table.division(), spec, train_fraction, seed);
  result.split = rows.split;
  if (!job.is_wanted()) return result;
  FeatureMatrix fused;
  if (job.has_network()) {
    result.network = train_network(job, rows, table, spec, seed, stop);
    result.embeddings = embedding_matrix(result.network->embed(table.centres));
    fused = join_columns(table.handmade, result.embeddings);
  }
  const FeatureMatrix* features[kModels] = {&table.handmade, &result.embeddings, &fused, &table.extended};
  for (std::size_t group = 0; group < kModels; ++group) {
    if (!job.groups[group]) continue;
    result.train_rows[group] = rows.trees.size();
    const Booster booster = trees_of(*features[group], table, rows.trees, spec, stop);
    result.predictions[group] = predict_rows(booster, *features[group], table, result.split.test);
    const LogisticModel linear = LogisticModel::train(select_rows(*features[group], rows.trees),
                                                      select(table.labels, rows.trees), table.classes.size());
    result.linear[group] = predict_rows(linear, *features[group], table, result.split.test);
    result.boosters[group] = booster;
  }
  return result;
}

// Fits the network and the trees of every group to all rows that are not held out, in place of those of the first
// split. Without the network trees have all of these rows, as the primary results do.
void refit(Study& study, const LearningTable& table, const LearningSpec& spec, std::uint64_t seed,
           const StopFlag* stop) {
  const Division division = table.division();
  const Job job{static_cast<std::uint64_t>(spec.split_repeats), Protocol::kGroup, spec.fusion};
  JobRows rows;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const bool is_held_out = !division.held_out.empty() && division.held_out[row];
    (is_held_out ? rows.split.test : rows.split.train).push_back(row);
  }
  Split fusion = split_for_fusion(division.units, rows.split, job.protocol, spec.network_fraction, seed, job.repeat);
  rows.fit = std::move(fusion.train);
  rows.validation = std::move(fusion.test);
  study.network = train_network(job, rows, table, spec, seed, stop);

  const FeatureMatrix embeddings = embedding_matrix(study.network->embed(table.centres));
  const FeatureMatrix fused = join_columns(table.handmade, embeddings);
  const FeatureMatrix* features[kModels] = {&table.handmade, &embeddings, &fused, &table.extended};
  for (std::size_t group = 0; group < kModels; ++group) {
    const bool reads_unseen = kHasNetwork[group] && spec.fusion == Fusion::kSplit;
    const std::vector<std::size_t>& fitted = reads_unseen ? rows.validation : rows.split.train;
    study.trees[group] = trees_of(*features[group], table, fitted, spec, stop);
  }
  study.splits.back() = std::move(rows.split);
}

// Bootstrap keys: a block of 1000 per evaluation, in the order primary and alternative of the random, then of the group
// protocol, of each group of features; then the probes. Within a block: the total, the bins of the wave height, from
// kFirstDrawn on kMostBins for each drawn key, then the swept quantities.
constexpr std::uint64_t kBootstrapBlock = 1000;
constexpr std::uint64_t kFirstDrawn = kMostSweptBins + 1;

class Evaluator {
 public:
  Evaluator(const LearningSpec& spec, std::uint64_t seed, std::vector<Condition> conditions)
      : spec_(spec), seed_(seed), conditions_(std::move(conditions)) {}

  Evaluation operator()(const std::vector<Prediction>& predictions, std::size_t train_rows,
                        std::vector<ConditionScores>* by_condition = nullptr) {
    const std::uint64_t index = kBootstrapBlock * next_++;
    Evaluation evaluation{score(predictions, spec_.bootstrap_samples, seed_, index), {}, train_rows};
    if (conditions_.empty()) return evaluation;
    const auto by = [&](const Condition& condition, std::uint64_t first) {
      return score_by(condition, predictions, spec_.bootstrap_samples, seed_, index + first);
    };
    evaluation.by_wave_height = by(conditions_.front(), 1).bins;
    std::uint64_t first = kFirstDrawn;
    for (std::size_t i = 1; by_condition != nullptr && i < conditions_.size(); ++i) {
      by_condition->push_back(by(conditions_[i], first));
      first += std::max(kMostBins, conditions_[i].bins.size());
    }
    return evaluation;
  }
  // An evaluation that is left out keeps its block.
  void skip() { ++next_; }

 private:
  const LearningSpec& spec_;
  std::uint64_t seed_;
  std::vector<Condition> conditions_;  // conditions_of(); empty without columns of the maps
  std::uint64_t next_ = 0;
};

// Rows that a prediction of several splits gets wrong are listed once, by the surest one.
std::vector<Prediction> surest_errors(std::vector<Prediction> predictions) {
  std::erase_if(predictions, [](const Prediction& prediction) { return prediction.decision() == prediction.label; });
  std::ranges::stable_sort(predictions, {}, [](const Prediction& wrong) { return -wrong.of(wrong.decision()); });
  std::vector<Prediction> errors;
  for (const Prediction& wrong : predictions)
    if (errors.size() < kMostWrong && std::ranges::find(errors, wrong.row, &Prediction::row) == errors.end())
      errors.push_back(wrong);
  return errors;
}

std::vector<ProbeResult> run_probes(const LearningTable& table, const LearningSpec& spec, double train_fraction,
                                    std::uint64_t seed, StudyScope scope, Evaluator& evaluate, Progress& progress,
                                    const StopFlag* stop) {
  std::vector<ProbeResult> results;
  for (const Probe& probe : table.probes) {
    ProbeResult result{probe.name, probe.kind, probe.meaning, {}};
    for (const Protocol protocol : kProtocols) {
      if (scope == StudyScope::kPrimary && protocol != Protocol::kGroup) {
        evaluate.skip();
        continue;
      }
      std::vector<Prediction> predictions;
      std::size_t train_rows = 0;
      for (int repeat = 0; repeat < spec.split_repeats; ++repeat) {
        const Split split =
            divide(table.division(), protocol, train_fraction, seed, static_cast<std::uint64_t>(repeat));
        const Booster booster = trees_of(probe.features, table, split.train, spec, stop);
        const std::vector<Prediction> more = predict_rows(booster, probe.features, table, split.test);
        predictions.insert(predictions.end(), more.begin(), more.end());
        if (repeat == 0) train_rows = split.train.size();
        progress.advance();
      }
      result.evaluations.push_back(evaluate(predictions, train_rows));
    }
    results.push_back(std::move(result));
  }
  return results;
}

std::string splits_csv(const LearningTable& table, const std::vector<Split>& splits) {
  std::string text = "data_set,sample,group,seed,sea_key,label,random,by_group\n";
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto side = [row](const Split& split) {
      if (std::binary_search(split.train.begin(), split.train.end(), row)) return "train";
      return std::binary_search(split.test.begin(), split.test.end(), row) ? "test" : "unused";
    };
    const SampleRecord& record = table.maps[row].record;
    text += fmt::format("{},{},{},{},{},{},{},{}\n", table.maps[row].data_set, record.sample, table.groups[row].group,
                        record.seed, record.sea_key, table.labels[row], side(splits[0]), side(splits[1]));
  }
  return text;
}

}  // namespace

std::uint64_t bootstrap_index(std::size_t group, Protocol protocol) {
  return kBootstrapBlock * (4 * group + (protocol == Protocol::kGroup ? 2 : 0));
}

const Outcome& outcome_of(const Study& study, std::string_view group, Protocol protocol) {
  const auto of_group = std::ranges::find(study.groups, group, &FeatureGroupResult::name);
  SEAGLINT_CHECK(of_group != study.groups.end(), fmt::format("no group {}", group));
  const auto outcome = std::ranges::find(of_group->outcomes, protocol, &Outcome::protocol);
  SEAGLINT_CHECK(outcome != of_group->outcomes.end(), fmt::format("no protocol {}", name(protocol)));
  return *outcome;
}

FeatureMatrix embedding_matrix(const Embeddings& embeddings) {
  FeatureMatrix matrix;
  for (std::size_t k = 0; k < embeddings.size; ++k) matrix.names.push_back(fmt::format("lambda_{}", k + 1));
  const std::size_t outputs = embeddings.outputs;
  for (std::size_t k = 0; k < outputs; ++k) matrix.names.push_back(outputs == 1 ? "logit" : fmt::format("logit_{}", k));
  const auto append = [&](const std::vector<float>& values, std::size_t row, std::size_t count) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row * count);
    matrix.values.insert(matrix.values.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  for (std::size_t i = 0; i < embeddings.logits.size() / outputs; ++i) {
    append(embeddings.values, i, embeddings.size);
    append(embeddings.logits, i, outputs);
  }
  return matrix;
}

void check_splits(const Division& division, const LearningSpec& spec, double train_fraction, std::uint64_t seed) {
  for (const Job& job : all_jobs(spec)) rows_of(job, division, spec, train_fraction, seed);
}

Study run_study(const LearningTable& table, const LearningSpec& spec, double train_fraction, std::uint64_t seed,
                int threads, const StopFlag* stop, StudyScope scope) {
  load_layers_library();
  // libtorch waits for ever, or ends the process, when it cannot start its threads, one per processor of 8 MB stack;
  // each of ours takes 64 MB of address space for its own memory.
  require_address_space((std::size_t{8} * thread_count(0) + std::size_t{64} * std::min(threads, 4) + 64) << 20,
                        "learning");
  const std::vector<Job> jobs = all_jobs(spec, scope);
  const std::size_t repeats = static_cast<std::size_t>(spec.split_repeats);
  std::vector<JobResult> done(jobs.size());
  const auto wanted = static_cast<std::size_t>(std::ranges::count_if(jobs, &Job::is_wanted));
  const std::size_t protocols = scope == StudyScope::kFull ? 2 : 1;
  Progress progress("training", wanted + table.probes.size() * protocols * repeats);
  parallel_for(
      jobs.size(), threads,
      [&](std::size_t i) {
        done[i] = run_job(jobs[i], table, spec, train_fraction, seed, stop);
        if (jobs[i].is_wanted()) progress.advance();
      },
      stop);

  // Results of all repeats of a protocol, with the primary fusion of the group of features or the other one.
  const auto first_job = [&](std::size_t protocol, std::size_t group, bool primary) {
    const std::size_t other = (primary_fusion(group, spec) == spec.fusion) == primary ? 0 : 1;
    return (protocol * 2 + other) * repeats;
  };
  const auto evaluated = [&](Evaluator& evaluate, std::size_t first, std::size_t group,
                             std::vector<Prediction>(JobResult::*kind)[kModels],
                             Outcome* primary = nullptr) -> std::optional<Evaluation> {
    if (!jobs[first].groups[group]) {
      evaluate.skip();
      return {};
    }
    std::vector<Prediction> predictions;
    for (std::size_t repeat = 0; repeat < repeats; ++repeat) {
      const auto& more = (done[first + repeat].*kind)[group];
      predictions.insert(predictions.end(), more.begin(), more.end());
    }
    if (primary != nullptr) {
      primary->roc = roc_curves(predictions);
      primary->wrong = surest_errors(predictions);
    }
    return evaluate(predictions, done[first].train_rows[group], primary ? &primary->by_condition : nullptr);
  };

  Study study;
  study.classes = table.classes;
  Evaluator evaluate(spec, seed, conditions_of(table.maps));
  for (std::size_t group = 0; group < kModels; ++group) {
    FeatureGroupResult result;
    result.name = kModelNames[group];
    for (std::size_t protocol = 0; protocol < 2; ++protocol) {
      Outcome outcome;
      outcome.protocol = kProtocols[protocol];
      const std::size_t place = first_job(protocol, group, true);
      const auto primary = evaluated(evaluate, place, group, &JobResult::predictions, &outcome);
      outcome.alternative = evaluated(evaluate, first_job(protocol, group, false), group, &JobResult::predictions);
      if (!primary) continue;
      outcome.primary = *primary;
      if (kProtocols[protocol] == Protocol::kGroup) {
        const JobResult& first = done[place];
        const auto& made = group == 3 ? table.extended.names : table.handmade.names;
        if (group != 1) result.columns = made;
        if (kHasNetwork[group])
          result.columns.insert(result.columns.end(), first.embeddings.names.begin(), first.embeddings.names.end());
        result.gain = first.boosters[group]->gains(result.columns.size());
        study.trees.push_back(*first.boosters[group]);
      }
      result.outcomes.push_back(outcome);
    }
    study.groups.push_back(std::move(result));
  }
  study.probes = run_probes(table, spec, train_fraction, seed, scope, evaluate, progress, stop);
  for (std::size_t group = 0; group < kModels; ++group) {
    std::size_t place = 0;
    for (std::size_t protocol = 0; protocol < 2; ++protocol) {
      const auto linear = evaluated(evaluate, first_job(protocol, group, true), group, &JobResult::linear);
      if (linear) study.groups[group].outcomes[place++].linear = *linear;
    }
  }

  const JobResult& random = done[0];
  JobResult& group = done[2 * repeats];
  study.network = std::move(group.network);
  study.splits = {random.split, group.split};
  study.embeddings = std::move(group.embeddings);
  study.division = table.division().text;
  if (spec.refit) refit(study, table, spec, seed, stop);
  return study;
}

std::vector<std::string> model_files() {
  std::vector<std::string> files{kNetworkFile, kSplitsFile, kModelFile};
  for (const char* name : kModelNames) files.push_back(fmt::format("{}.json", name));
  return files;
}

void save_models(const Study& study, const LearningTable& table, const std::filesystem::path& model_directory) {
  for (std::size_t group = 0; group < kModels; ++group)
    study.trees[group].save(model_directory / fmt::format("{}.json", kModelNames[group]));
  study.network->save(model_directory / kNetworkFile);
  write_file(model_directory / kSplitsFile, splits_csv(table, study.splits));
}

namespace {

using nlohmann::ordered_json;

ordered_json to_object(const Evaluation& evaluation, const std::vector<std::string>& classes) {
  ordered_json json = to_object(evaluation.scores, classes);
  json["train_rows"] = evaluation.train_rows;
  json["by_wave_height"] = ordered_json::array();
  for (const BinnedScores& entry : evaluation.by_wave_height) {
    json["by_wave_height"].push_back(
        {{kWaveHeightColumn, entry.mean}, {"bin", entry.text}, {"lowest", entry.lowest}, {"highest", entry.highest}});
    json["by_wave_height"].back().update(to_object(entry.scores, classes));
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
      for (const ConditionScores& condition : outcome.by_condition)
        entry[name(outcome.protocol)]["by_condition"].push_back(to_object(condition, study.classes));
      for (const Prediction& wrong : outcome.wrong)
        entry[name(outcome.protocol)]["wrong"].push_back({{"row", wrong.row},
                                                          {"label", wrong.label},
                                                          {"declared", wrong.decision()},
                                                          {"probability", wrong.of(wrong.decision())}});
      if (outcome.alternative) others[name(outcome.protocol)] = to_object(*outcome.alternative, study.classes);
    }
    if (!others.empty()) entry[network ? fusion_name(other_fusion(spec.fusion)) : "fewer_rows"] = others;
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

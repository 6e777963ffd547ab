// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "classify/model/classifiers.h"
#include "classify/model/model_card.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/out_of_memory.h"
#include "sim/core/process/progress.h"

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
    const Booster booster = Booster::train(select_rows(*features[group], rows.trees), select(table.labels, rows.trees),
                                           spec, stop, table.classes.size());
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
    study.trees[group] = Booster::train(select_rows(*features[group], fitted), select(table.labels, fitted), spec, stop,
                                        table.classes.size());
  }
  study.splits.back() = std::move(rows.split);
}

// Bootstrap keys: a block of 1000 per evaluation, in the order primary and alternative of the random, then of the group
// protocol, of each group of features; then the probes. Within a block: the total, the bins of the wave height, from
// kFirstDrawn on kMostBins for each drawn key.
constexpr std::uint64_t kBootstrapBlock = 1000;
constexpr std::uint64_t kFirstDrawn = kMostSweptBins + 1;

class Evaluator {
 public:
  Evaluator(const LearningSpec& spec, std::uint64_t seed, std::vector<Condition> conditions)
      : spec_(spec), seed_(seed), conditions_(std::move(conditions)) {}

  Evaluation operator()(const std::vector<Prediction>& predictions, std::size_t train_rows,
                        std::vector<ConditionScores>* by_drawn = nullptr) {
    const std::uint64_t index = kBootstrapBlock * next_++;
    Evaluation evaluation{score(predictions, spec_.bootstrap_samples, seed_, index), {}, train_rows};
    if (conditions_.empty()) return evaluation;
    const auto by = [&](const Condition& condition, std::uint64_t first) {
      return score_by(condition, predictions, spec_.bootstrap_samples, seed_, index + first);
    };
    evaluation.by_wave_height = by(conditions_.front(), 1).bins;
    for (std::size_t i = 1; by_drawn != nullptr && i < conditions_.size(); ++i)
      by_drawn->push_back(by(conditions_[i], kFirstDrawn + kMostBins * (i - 1)));
    return evaluation;
  }
  // An evaluation that is left out keeps its block.
  void skip() { ++next_; }

 private:
  const LearningSpec& spec_;
  std::uint64_t seed_;
  std::vector<Condition> conditions_;  // the wave height, then the drawn keys; empty without columns of the maps
  std::uint64_t next_ = 0;
};

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
        const Booster booster = Booster::train(select_rows(probe.features, split.train),
                                               select(table.labels, split.train), spec, stop, table.classes.size());
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
    if (primary != nullptr) primary->roc = roc_curves(predictions);
    return evaluate(predictions, done[first].train_rows[group], primary ? &primary->by_drawn : nullptr);
  };

  Study study;
  study.classes = table.classes;
  Evaluator evaluate(spec, seed, drawn_conditions(table.maps));
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

}  // namespace seaglint

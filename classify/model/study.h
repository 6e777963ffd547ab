// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Evaluation of a data set: four groups of features (the paper's hand-made ones, network, both; hand-made with
// motion_features()), each with the same trees, under two protocols (random rows as in the paper, whole seas) and two
// fusions of network and trees, with probes for leaks of the class.

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "classify/cnn/network.h"
#include "classify/model/data_rows.h"
#include "classify/model/learning_table.h"
#include "classify/model/scores.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

// Trees on hand-made features, on the network's outputs, on both, on hand-made and motion_features().
inline constexpr std::array kModelNames{"handmade", "cnn", "fused", "extended"};
inline constexpr std::size_t kModels = kModelNames.size();
inline constexpr std::size_t kMostWrong = 12;

struct Evaluation {
  Scores scores;
  std::vector<BinnedScores> by_wave_height;
  std::size_t train_rows = 0;  // training rows of the trees, first repeat
};

// Results of one group of features under one protocol.
struct Outcome {
  Protocol protocol = Protocol::kGroup;
  // Without the network (hand-made, extended): trees on all training rows, and on their rows of fusion `split`; with
  // it: the scenario's fusion and the other one.
  Evaluation primary;
  std::optional<Evaluation> alternative;      // absent in StudyScope::kPrimary
  Evaluation linear;                          // logistic regression in place of the trees of the primary
  std::vector<std::vector<RocPoint>> roc;     // of the primary: roc_curves()
  std::vector<ConditionScores> by_condition;  // of the primary, by conditions_of() after the wave height
  std::vector<Prediction> wrong;              // of the primary, the surest first: at most kMostWrong rows, each once
};

struct FeatureGroupResult {
  std::string name;  // handmade, cnn, fused, extended
  std::vector<std::string> columns;
  std::vector<double> gain;       // fraction of the trees' gain per column, group protocol, first repeat
  std::vector<Outcome> outcomes;  // random, then group; group alone in StudyScope::kPrimary

  const Outcome& of_group() const { return outcomes.back(); }
};

struct ProbeResult {
  std::string name;
  ProbeKind kind = ProbeKind::kBlind;
  std::string meaning;
  std::vector<Evaluation> evaluations;  // as FeatureGroupResult::outcomes

  const Evaluation& of_group() const { return evaluations.back(); }
  const Evaluation& of(Protocol protocol) const {
    return protocol == Protocol::kGroup ? evaluations.back() : evaluations.front();
  }
};

// kPrimary: the primary results of the group protocol, with the same figures as in kFull by one of six trainings of the
// network.
enum class StudyScope { kFull, kPrimary };

// The models are those of the group protocol, main fusion, first repeat.
struct Study {
  std::vector<std::string> classes = default_classes();  // names by label
  std::vector<FeatureGroupResult> groups;                // handmade, cnn, fused, extended
  std::vector<ProbeResult> probes;
  // The saved model: of the group protocol's first repeat, with learning.refit of all rows that are not held out.
  std::optional<Network> network;  // always set in a finished study
  std::vector<Booster> trees;      // handmade, cnn, fused, extended
  std::vector<Split> splits;       // random, of the first repeat; then that of the saved model
  FeatureMatrix embeddings;        // of all rows, by the first repeat's network: embedding values, then the logit
  std::string division;            // how the group protocol divides
};

// Of the group of this name under a protocol that the study has.
const Outcome& outcome_of(const Study& study, std::string_view group, Protocol protocol = Protocol::kGroup);

// The network's outputs as columns lambda_1, lambda_2, ..., logit; of more than two classes logit_0, logit_1, ...
FeatureMatrix embedding_matrix(const Embeddings& embeddings);

// Random index of the interval of a primary result (score()): `group` of Study::groups.
std::uint64_t bootstrap_index(std::size_t group, Protocol protocol);

// Throws InputError when a split would have an empty side; needs no maps.
void check_splits(const Division& division, const LearningSpec& spec, double train_fraction, std::uint64_t seed);

inline constexpr const char* kNetworkFile = "network.bin";
inline constexpr const char* kModelFile = "model.json";
inline constexpr const char* kSplitsFile = "splits.csv";

// Trains and evaluates; writes nothing. The result depends only on data, spec and seed, not on `threads`. Throws
// InputError as check_splits() does, Interrupted when *stop becomes true.
Study run_study(const LearningTable& table, const LearningSpec& spec, double train_fraction, std::uint64_t seed,
                int threads, const StopFlag* stop = nullptr, StudyScope scope = StudyScope::kFull);

// Names of the files that save_models() and save_model_card() write.
std::vector<std::string> model_files();

// Writes network.bin, handmade.json, cnn.json, fused.json, extended.json and splits.csv of the table's study. In
// splits.csv, `random` and `by_group` are train, test or unused. Throws WorkError when a file
// cannot be written.
void save_models(const Study& study, const LearningTable& table, const std::filesystem::path& model_directory);

// Text output of a study: the accuracy table for the terminal and the numbers of metrics.json.

// Table of accuracies by wave height as plain text.
std::string accuracy_table(const Study& study);

// "93.3 (88-98)": accuracy in % with its 95 % interval, if there is one; "-" without rows.
std::string percent(const Scores& scores);

// The name of a class in names of columns and members: '_' for a space.
std::string one_word(std::string class_name);
// "probability_fused"; of more than two classes "probability_fused_ship", one for each.
std::vector<std::string> probability_columns(const std::string& model, const std::vector<std::string>& classes);

// JSON objects of scores and of roc_curves(), for more than two classes by class name; undefined values are null.
nlohmann::ordered_json to_object(const Scores& scores, const std::vector<std::string>& classes);
nlohmann::ordered_json to_object(const std::vector<std::vector<RocPoint>>& curves,
                                 const std::vector<std::string>& classes);

// The study as a JSON object with the members handmade, cnn, fused, extended, probes, network; without what the scope
// of the study leaves out.
nlohmann::ordered_json to_json(const Study& study, const LearningSpec& spec);

}  // namespace seaglint

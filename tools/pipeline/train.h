// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Writes a model directory from one or more data sets: network, trees, splits, embeddings of all maps, model.json for
// the application to other data (classify/model/saved_model.h), and last metrics.json: a directory without it is no
// complete model.

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/model/division.h"
#include "classify/model/study.h"
#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

inline constexpr const char* kMetricsFile = "metrics.json";
inline constexpr const char* kEmbeddingsFile = "embeddings.csv";

// Options in place of learning.split of the scenario.
struct DivisionOptions {
  std::optional<std::string> by;
  std::vector<HoldOutSpec> hold_out;  // empty: those of the scenario
};

struct TrainRequest {
  std::vector<std::filesystem::path> data_sets;
  std::filesystem::path model_directory;  // created; an earlier model there is replaced only when all is computed
  std::vector<Override> overrides = {};   // of the scenario of the first data set: learning, split and seed
  DivisionOptions division = {};
  const Scenario* scenario = nullptr;  // in place of that scenario
  int threads = 0;                     // 0 = all processors
  const StopFlag* stop = nullptr;
  std::function<void(const Shard&)> use = {};  // is passed every shard, which is read once
  StudyScope scope = StudyScope::kFull;
};

struct TrainedModel {
  Study study;
  std::string metrics;                // the content of metrics.json
  std::vector<std::string> warnings;  // data_set_warnings()
};

// Trains and evaluates. Throws InputError for an invalid data set, for several of which maps, features or classes have
// different settings or two are of one scenario, for a directory with other content, and for a division that leaves
// nothing, or one class only, to train or to test on; WorkError when a file cannot be written, Interrupted when *stop
// becomes true.
TrainedModel train_model(const TrainRequest& request);

// Throws InputError when a side of the group protocol is empty or of one class only, or no map of a class is trained
// on, in any repeat.
void require_classes(const Division& division, std::span<const int> labels, const Scenario& scenario);

}  // namespace seaglint

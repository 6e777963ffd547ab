// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Writes a model directory from one or more data sets: network, trees, splits, embeddings of all maps, model.json for
// the application to other data (classify/model/saved_model.h), and last metrics.json: a directory without it is no
// complete model.

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
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

struct TrainedModel {
  Study study;
  nlohmann::ordered_json metrics;  // the content of metrics.json
};

// Options in place of learning.split of the scenario.
struct DivisionOptions {
  std::optional<std::string> by;
  std::vector<HoldOutSpec> hold_out;  // empty: those of the scenario
};

// Trains and evaluates with the learning section of the data set's scenario; every shard is read once and passed to
// `use` if given. `scope`: StudyScope. The model directory is created; an earlier model there is replaced only when all
// is computed. Throws InputError for an invalid data set, a directory with other content, or a division that leaves
// nothing, or one class only, to train or to test on, WorkError when a file cannot be written, Interrupted when *stop
// becomes true.
TrainedModel train_model(const DatasetReader& data, const Scenario& scenario,
                         const std::filesystem::path& model_directory, int threads, const StopFlag* stop = nullptr,
                         const std::function<void(const Shard&)>& use = {}, StudyScope scope = StudyScope::kFull);

// The same with several data sets. Learning, split and seed are those of the scenario of the first data set, changed by
// `overrides` and `division`. Prints data_set_warnings(). Throws InputError also when maps or features of the data sets
// have different settings, or two data sets are of one scenario.
TrainedModel train_model(const std::vector<std::filesystem::path>& data_sets,
                         const std::filesystem::path& model_directory, const std::vector<Override>& overrides,
                         const DivisionOptions& division, int threads, const StopFlag* stop = nullptr);

// The same with one data set, divided as its scenario states.
TrainedModel train_model(const std::filesystem::path& data_set, const std::filesystem::path& model_directory,
                         const std::vector<Override>& overrides, int threads, const StopFlag* stop = nullptr);

// Throws InputError when a side of the group protocol is empty or of one class only, or no map of a class is trained
// on, in any repeat.
void require_classes(const Division& division, std::span<const int> labels, const Scenario& scenario);

}  // namespace seaglint

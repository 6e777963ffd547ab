// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Writes a model directory from a data set: network, trees, splits, embeddings of all maps, and last metrics.json: a
// directory without it is no complete model.

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
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

// Trains and evaluates with the learning section of the data set's scenario; every shard is read once and passed to
// `use` if given. The model directory is created; an earlier model there is replaced only when all is computed. Throws
// InputError for an invalid data set or a directory with other content, WorkError when a file cannot be written,
// Interrupted when *stop becomes true.
TrainedModel train_model(const DatasetReader& data, const Scenario& scenario,
                         const std::filesystem::path& model_directory, int threads, const StopFlag* stop = nullptr,
                         const std::function<void(const Shard&)>& use = {});

// The same with the scenario stored in the data set, changed by `overrides`; prints data_set_warnings().
TrainedModel train_model(const std::filesystem::path& data_set, const std::filesystem::path& model_directory,
                         const std::vector<Override>& overrides, int threads, const StopFlag* stop = nullptr);

}  // namespace seaglint

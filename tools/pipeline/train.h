// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A model directory from a data set: network, trees, splits, embeddings of all maps, and metrics.json, which is written
// last: a directory without it holds no whole model.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
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
  nlohmann::ordered_json metrics;  // as metrics.json has them
};

// Trains and evaluates with the learning section of the data set's scenario; every shard is read once and handed on to
// `use` where there is one. The model directory is made; what an earlier training left there is replaced when all is
// computed, and stays as it was when the training is stopped before. Throws InputError for an unsound data set or a
// directory of something else, WorkError when the disk refuses, Interrupted when *stop becomes true.
TrainedModel train_model(const DatasetReader& data, const Scenario& scenario,
                         const std::filesystem::path& model_directory, int threads, const StopFlag* stop = nullptr,
                         const std::function<void(const Shard&)>& use = {});

// Likewise, with the scenario that the data set keeps, changed by `overrides`.
TrainedModel train_model(const std::filesystem::path& data_set, const std::filesystem::path& model_directory,
                         const std::vector<Override>& overrides, int threads, const StopFlag* stop = nullptr);

// The columns of embeddings.csv after those about the sample: hand-made features, then the network's. Throws InputError
// naming file and line where it is not a table of these samples.
FeatureMatrix read_embeddings(const std::filesystem::path& file, std::span<const std::int64_t> samples);

}  // namespace seaglint

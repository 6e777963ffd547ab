// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A model directory from a data set: network, trees, splits, embeddings of all maps, metrics.json.

#include <filesystem>
#include <string>
#include <vector>

#include "classify/model/study.h"
#include "sim/core/parallel.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

inline constexpr const char* kMetricsFile = "metrics.json";
inline constexpr const char* kEmbeddingsFile = "embeddings.csv";

// Trains and evaluates with the learning section of the data set's own scenario, changed by `overrides`. The model
// directory is made; what an earlier training left there is replaced. Throws InputError for an unsound data set or a
// directory of something else.
Study train_model(const std::filesystem::path& data_set, const std::filesystem::path& model_directory,
                  const std::vector<Override>& overrides, int threads, const StopFlag* stop = nullptr);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A model directory from a data set: network, trees, splits, embeddings of all maps, and metrics.json, which is written
// last: a directory without it holds no whole model.

#include <filesystem>
#include <string>
#include <vector>

#include "classify/model/study.h"
#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

inline constexpr const char* kMetricsFile = "metrics.json";
inline constexpr const char* kEmbeddingsFile = "embeddings.csv";

// Trains and evaluates with the learning section of the data set's own scenario, changed by `overrides`. The model
// directory is made; what an earlier training left there is replaced when all is computed, and stays as it was when the
// training is stopped before. Throws InputError for an unsound data set or a directory of something else, WorkError
// when the disk refuses, Interrupted when *stop becomes true.
Study train_model(const std::filesystem::path& data_set, const std::filesystem::path& model_directory,
                  const std::vector<Override>& overrides, int threads, const StopFlag* stop = nullptr);

}  // namespace seaglint

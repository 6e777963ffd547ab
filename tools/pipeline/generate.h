// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Generates a data set directory from a scenario. The samples of a shard are generated in parallel; each shard is
// written completely or not at all.

#include <filesystem>
#include <functional>

#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

struct GenerateOptions {
  int part = 1;  // this job's part of the shards, 1..parts
  int parts = 1;
  bool resume = false;  // keep existing shards that are valid
  int threads = 0;      // 0 = all processors
  // Response of a sample's target in place of a computed one; from any thread.
  std::function<IntervalResult(std::size_t sample, const PulseTrain& train)> response = {};
};

struct GenerateResult {
  std::size_t made = 0;     // samples generated now
  std::size_t kept = 0;     // samples of this part in existing shards
  std::size_t missing = 0;  // shards of other parts that are missing or damaged; 0 = the data set is complete
};

// The bytes of a shard depend only on scenario, program and processor. On a stop, finished shards are kept and
// Interrupted is thrown.
GenerateResult generate_dataset(const Pipeline& pipeline, const std::filesystem::path& directory,
                                const GenerateOptions& options, const StopFlag* stop = nullptr);

}  // namespace seaglint

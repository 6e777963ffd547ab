// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A data set directory from a scenario. Shards are made sample by sample on any number of threads and written whole.

#include <filesystem>

#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

struct GenerateOptions {
  int part = 1;  // this job's part of the shards, 1..parts
  int parts = 1;
  bool resume = false;  // keep the sound shards that are there
  int threads = 0;      // 0 = all processors
};

struct GenerateResult {
  std::size_t made = 0;     // samples made now
  std::size_t kept = 0;     // samples of this part that were there already
  std::size_t missing = 0;  // shards of other parts that are missing or damaged; 0 = the data set is whole
};

// The bytes of every shard depend on scenario and program alone. Throws Interrupted after whole shards only.
GenerateResult generate_dataset(const Pipeline& pipeline, const std::filesystem::path& directory,
                                const GenerateOptions& options, const StopFlag* stop = nullptr);
GenerateResult generate_dataset(const Scenario& scenario, const std::filesystem::path& directory,
                                const GenerateOptions& options, const StopFlag* stop = nullptr);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/generate.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <vector>

#include "classify/dataset/directory/dataset_writer.h"
#include "seaglint_version.h"
#include "sim/core/process/address_space.h"
#include "sim/core/process/error.h"
#include "sim/core/process/progress.h"
#include "tools/pipeline/constant_keys.h"
#include "tools/pipeline/map_coverage.h"
#include "tools/pipeline/motion_summary.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace {

// A shard being assembled from samples in any order.
struct OpenShard {
  Shard content;
  std::size_t waiting = 0;  // samples not yet generated
};

GeneratedSample made_sample(const Pipeline& pipeline, std::size_t sample, const GenerateOptions& options) {
  if (!options.response) return pipeline.generate_sample(sample);
  const PulseTrain train = pipeline.pulse_train(sample);
  return pipeline.received_sample(sample, train, options.response(sample, train));
}

}  // namespace

GenerateResult generate_dataset(const Pipeline& pipeline, const std::filesystem::path& directory,
                                const GenerateOptions& options, const StopFlag* stop) {
  // FFTW ends the process when it has no memory.
  require_address_space(std::size_t{32} * (2 + std::min(thread_count(options.threads), 8)) << 20, "making maps");
  const Scenario& scenario = pipeline.scenario();
  const SamplePlan& plan = pipeline.plan();
  report_motion_files(pipeline);
  report_spectrum_table(scenario);
  if (!options.response) report_rest(scenario, target_motions(pipeline));
  warn(mesh_warnings(pipeline));
  warn(motion_warnings(pipeline));
  warn(sea_warnings(scenario, plan.sea_states()));
  warn(band_warnings(pipeline));
  warn(map_coverage_warnings(pipeline));
  DatasetWriter writer(directory, scenario, plan, options.resume, kVersion);

  // The part's shards to be generated, and their samples in order.
  GenerateResult result;
  struct Work {
    std::size_t shard = 0;
    std::size_t sample = 0;
  };
  std::vector<Work> work;
  std::map<std::size_t, OpenShard> open;
  const std::size_t shards = plan.shards(), parts = static_cast<std::size_t>(options.parts),
                    part = static_cast<std::size_t>(options.part);
  const std::size_t first = (part - 1) * shards / parts, end = part * shards / parts;
  for (std::size_t shard = first; shard < end; ++shard) {
    const ShardRange range = plan.shard(shard);
    if (writer.complete(shard)) {
      result.kept += range.count;
      continue;
    }
    open[shard].waiting = range.count;
    for (std::size_t i = 0; i < range.count; ++i) work.push_back({shard, range.first + i});
  }

  // Stored echoes vary as they did when they were made.
  if (!work.empty() && !options.response) warn(constant_key_warnings(pipeline, {kTrialSeconds, stop}));
  Progress progress("making maps", work.size());
  std::mutex mutex;
  try {
    parallel_for(
        work.size(), thread_count(options.threads),
        [&](std::size_t i) {
          GeneratedSample made = made_sample(pipeline, work[i].sample, options);
          const ShardRange range = plan.shard(work[i].shard);
          Shard whole;
          {
            const std::lock_guard lock(mutex);
            OpenShard& shard = open[work[i].shard];
            shard.content.samples.resize(range.count);
            shard.content.axes = stored_axes(made.received.map);
            shard.content.samples[work[i].sample - range.first] = std::move(made.stored);
            if (--shard.waiting == 0) {
              whole = std::move(shard.content);
              open.erase(work[i].shard);
            }
          }
          if (!whole.samples.empty()) writer.put(work[i].shard, std::move(whole));
          progress.advance();
        },
        stop);
  } catch (const InputError&) {
    // A corrected scenario needs the directory in its previous state; not with several parts, which may be writing to
    // it.
    if (parts == 1) writer.roll_back();
    throw;
  }
  result.made = work.size();
  const std::vector<std::size_t> missing = writer.finish();
  for (const std::size_t shard : missing) {
    if (shard < first || shard >= end) continue;
    throw WorkError(
        fmt::format("{}: was written and is now missing or damaged; go on by the same command with --resume",
                    (directory / shard_name(shard)).string()));
  }
  result.missing = missing.size();
  return result;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/generate.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <type_traits>
#include <vector>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/dataset/format/shard.h"
#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/process/out_of_memory.h"
#include "sim/core/process/printable.h"
#include "sim/core/process/progress.h"
#include "sim/scenario/scenario.h"
#include "tools/pipeline/scenario_check.h"
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
  return with_all_looks(pipeline.looks_of_responses(sample, options.response));
}

}  // namespace

GenerateResult generate_dataset(const Pipeline& pipeline, const std::filesystem::path& directory,
                                const GenerateOptions& options, const StopFlag* stop) {
  // FFTW ends the process when it has no memory.
  require_address_space(std::size_t{32} * (2 + std::min(thread_count(options.threads), 8)) << 20, "making maps");
  const Scenario& scenario = pipeline.scenario();
  const SamplePlan& plan = pipeline.plan();
  report_scenario(pipeline, {.rest = !options.response, .bands = true, .coverage = true});
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

namespace {

// The scenario with one value for everything that echoes do not depend on.
Scenario without_maps(Scenario scenario) {
  std::erase_if(scenario.variations,
                [](const Variation& variation) { return variation.key_path.starts_with("clutter."); });
  scenario.name = "echoes";
  scenario.clutter = {};
  scenario.map = {};
  scenario.features = {};
  scenario.learning = {};
  scenario.report = {};
  const DatasetSpec standard;
  scenario.dataset.train_fraction = standard.train_fraction;
  scenario.dataset.complex_maps = scenario.dataset.echoes = false;
  scenario.dataset.maps_per_shard = standard.maps_per_shard;
  return scenario;
}

// Number and file of the shard of a sample.
std::pair<std::size_t, const ManifestShard&> shard_of(const DatasetReader& reader, std::size_t sample) {
  const std::vector<ManifestShard>& shards = reader.manifest().shards;
  const auto found = std::ranges::find_if(
      shards, [&](const ManifestShard& shard) { return sample < shard.first_sample + shard.samples; });
  return {static_cast<std::size_t>(found - shards.begin()), *found};
}

}  // namespace

StoredEchoes::StoredEchoes(const DatasetReader& reader) : reader_(reader) {
  const auto first = shards_.get(0, [&] { return reader_.shard(0); });
  if (first->samples.front().echo.empty()) {
    throw InputError(fmt::format("{}: has no echoes; make it with dataset.echoes: true", reader.directory().string()));
  }
}

IntervalResult StoredEchoes::response(const SampleLook& of, const PulseTrain& train) const {
  const auto [number, file] = shard_of(reader_, of.sample);
  const auto shard = shards_.get(number, [&] {
    const std::lock_guard lock(hdf5_mutex());
    return reader_.shard(number);
  });
  const Sample& stored = look_of(shard->samples[of.sample - file.first_sample], of.look);
  IntervalResult response;
  response.response.pulses = static_cast<int>(train.pulses());
  response.response.frequencies_per_pulse = static_cast<int>(train.frequencies());
  const std::size_t values = train.pulses() * train.frequencies();
  if (stored.echo.size() != 2 * values) {
    throw InputError(fmt::format("{}: sample {}: the echo has {} values, its pulses {}",
                                 (reader_.directory() / file.file).string(), of.sample, stored.echo.size() / 2,
                                 values));
  }
  for (std::size_t i = 0; i < values; ++i)
    response.response.values.emplace_back(stored.echo[2 * i], stored.echo[2 * i + 1]);
  response.traces = static_cast<int>(stored.record.aspect_traces);
  return response;
}

void require_same_echoes(const Pipeline& pipeline, const Scenario& stored) {
  const Scenario there = without_maps(stored), here = without_maps(pipeline.scenario());
  if (there != here) {
    throw InputError(fmt::format(
        "--set: only clutter, map, features, learning and report can be set, the stored echoes depend on the rest: {}",
        first_difference(effective_yaml(there), effective_yaml(here))));
  }
  const double before_m = pipeline.window_m_of(stored);
  if (before_m != pipeline.window_m()) {
    throw InputError(
        fmt::format("map.range_span_m: the stored echoes are those of a range window of {:.6g} m, here {:.6g} m",
                    before_m, pipeline.window_m()));
  }
}

namespace {

// Tolerance for another kind of processor, which may round transforms differently: fraction of the map's peak and of a
// measured column.
constexpr double kOtherProcessor = 1e-5;

bool agree(double a, double b, double tolerance) {
  return a == b || (std::isnan(a) && std::isnan(b)) ||
         std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

// Columns of a regenerated row that differ from the stored ones.
std::string different_columns(const SampleRecord& stored, const SampleRecord& again, double tolerance) {
  std::string names;
  for (const SampleColumn& column : sample_columns()) {
    const bool same = std::visit(
        [&](auto member) {
          const auto &a = stored.*member, &b = again.*member;
          if constexpr (std::is_same_v<std::decay_t<decltype(a)>, double>) {
            return agree(a, b, tolerance);
          } else {
            return a == b;
          }
        },
        column.member);
    if (!same) names += (names.empty() ? "" : ", ") + std::string(column.name);
  }
  if (!same_drawn(stored, again)) names += (names.empty() ? "" : ", ") + std::string("drawn values");
  return names;
}

// Largest difference of two maps; infinite when their sizes differ or one contains NaN.
double largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (a.size() != b.size()) return kInfinite;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(static_cast<double>(a[i]) - b[i]);
    if (std::isnan(difference)) return kInfinite;
    largest = std::max(largest, difference);
  }
  return largest;
}

}  // namespace

StoredSample stored_sample(const DatasetReader& reader, std::size_t sample) {
  const auto [number, file] = shard_of(reader, sample);
  Shard shard = reader.shard(number);
  return {std::move(shard.samples[sample - file.first_sample]), std::move(shard.axes), std::move(shard.origin)};
}

double reproduction_tolerance(const Provenance& origin) {
  return origin == Provenance{kVersion, processor_kind()} ? 0 : kOtherProcessor;
}

std::vector<std::string> differences(const Sample& stored, const Sample& again, double tolerance) {
  std::vector<std::string> found;
  if (look_count(stored) != look_count(again)) return {"it has other looks"};
  for (std::size_t i = 0; i < stored.further_looks.size(); ++i)
    for (const std::string& what : differences(stored.further_looks[i], again.further_looks[i], tolerance))
      found.push_back(fmt::format("in look {} {}", i + 1, what));
  const auto compare = [&](const char* name, const std::vector<float>& a, const std::vector<float>& b) {
    const double largest = largest_difference(a, b);
    if (!(largest <= tolerance * stored.record.peak_m))
      found.push_back(fmt::format("its {} differs by up to {:.3g} of its peak", name, largest / stored.record.peak_m));
  };
  compare("map", stored.magnitude, again.magnitude);
  if (!stored.complex_values.empty() && !again.complex_values.empty())
    compare("complex map", stored.complex_values, again.complex_values);
  if (!stored.echo.empty() && !again.echo.empty() && tolerance == 0 && stored.echo != again.echo)
    found.emplace_back("its echo differs");
  if (stored.hop_code != again.hop_code) found.emplace_back("its hop code differs");
  if (const std::string columns = different_columns(stored.record, again.record, tolerance); !columns.empty())
    found.push_back("other " + columns);
  return found;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/stored_echoes.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/process/error.h"
#include "sim/core/text/text_difference.h"
#include "sim/scenario/writer.h"

namespace seaglint {

namespace {

// The scenario with one value for everything that echoes do not depend on.
std::string echo_yaml(Scenario scenario) {
  std::erase_if(scenario.variations,
                [](const Variation& variation) { return variation.key_path.starts_with("clutter."); });
  scenario.name = "echoes";
  scenario.clutter = {};
  scenario.map = {};
  scenario.features = {};
  scenario.learning = {};
  const DatasetSpec standard;
  scenario.dataset.train_fraction = standard.train_fraction;
  scenario.dataset.complex_maps = scenario.dataset.echoes = false;
  scenario.dataset.maps_per_shard = standard.maps_per_shard;
  return effective_yaml(scenario);
}

}  // namespace

StoredEchoes::StoredEchoes(const DatasetReader& reader) : reader_(reader) {
  const auto first = shards_.get(0, [&] { return reader_.shard(0); });
  if (first->samples.front().echo.empty()) {
    throw InputError(fmt::format("{}: has no echoes; make it with dataset.echoes: true", reader.directory().string()));
  }
}

IntervalResult StoredEchoes::response(std::size_t sample, const PulseTrain& train) const {
  const std::vector<ManifestShard>& files = reader_.manifest().shards;
  const auto after = std::find_if(files.begin(), files.end(),
                                  [&](const ManifestShard& file) { return sample < file.first_sample + file.samples; });
  const auto shard = shards_.get(static_cast<std::size_t>(after - files.begin()), [&] {
    const std::lock_guard lock(hdf5_mutex());
    return reader_.shard(static_cast<std::size_t>(after - files.begin()));
  });
  const Sample& stored = shard->samples[sample - after->first_sample];
  IntervalResult response;
  response.response.pulses = static_cast<int>(train.pulses());
  response.response.frequencies_per_pulse = static_cast<int>(train.frequencies());
  const std::size_t values = train.pulses() * train.frequencies();
  if (stored.echo.size() != 2 * values) {
    throw InputError(fmt::format("{}: sample {}: the echo has {} values, its pulses {}",
                                 (reader_.directory() / after->file).string(), sample, stored.echo.size() / 2, values));
  }
  for (std::size_t i = 0; i < values; ++i)
    response.response.values.emplace_back(stored.echo[2 * i], stored.echo[2 * i + 1]);
  response.traces = static_cast<int>(stored.record.aspect_traces);
  return response;
}

void require_same_echoes(const Pipeline& pipeline, const Scenario& stored) {
  const std::string there = echo_yaml(stored), here = echo_yaml(pipeline.scenario());
  if (there != here) {
    throw InputError(fmt::format(
        "--set: only clutter, map, features and learning can be set, the stored echoes depend on the rest: {}",
        first_difference(there, here)));
  }
  const double before_m = range_window_m(stored, SamplePlan(stored), pipeline.targets());
  if (before_m != pipeline.window_m()) {
    throw InputError(
        fmt::format("map.range_span_m: the stored echoes are those of a range window of {:.6g} m, here {:.6g} m",
                    before_m, pipeline.window_m()));
  }
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Data sets of a scenario: generation shard by shard, stored echoes as responses for other maps, comparison of a stored
// sample with the same made again.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/process/parallel.h"
#include "sim/core/process/shared_results.h"
#include "sim/scattering/solver/solve.h"
#include "sim/scenario/scenario.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

// Generates a data set directory from a scenario. The samples of a shard are generated in parallel; each shard is
// written completely or not at all.

struct GenerateOptions {
  int part = 1;  // this job's part of the shards, 1..parts
  int parts = 1;
  bool resume = false;  // keep existing shards that are valid
  int threads = 0;      // 0 = all processors
  // Response of a sample's target in place of a computed one; from any thread.
  Pipeline::ResponseOfLook response = {};
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

// The echoes that a data set stores (dataset.echoes: true) as responses of its targets, for maps with other clutter,
// other map settings and other features.

// Reads a data set's echoes, shard by shard. Any thread may use it.
class StoredEchoes {
 public:
  // Throws InputError when the data set has no echoes.
  explicit StoredEchoes(const DatasetReader& reader);

  // The response of a target in a look at the pulses and frequencies of `train`, as it was computed, to the bit. Throws
  // InputError naming a damaged shard, or a sample whose echo has other pulses or frequencies.
  IntervalResult response(const SampleLook& of, const PulseTrain& train) const;

 private:
  static constexpr std::size_t kKept = 4;  // shards
  const DatasetReader& reader_;
  mutable SharedResults<std::size_t, Shard> shards_{kKept};
};

// Throws InputError, naming the key, when a pipeline's scenario differs from `stored`, that of the data set, in what
// its echoes depend on: everything but `clutter`, `map` (with the same range window), `features`, `learning`, name,
// and of `dataset` the split, complex_maps, echoes and maps_per_shard.
void require_same_echoes(const Pipeline& pipeline, const Scenario& stored);

// Comparison of a regenerated sample of a data set with the stored one.

struct StoredSample {
  Sample sample;
  StoredAxes axes;
  Provenance origin;  // program version and processor that wrote it
};

// sample < reader.size(). Throws InputError naming a damaged shard.
StoredSample stored_sample(const DatasetReader& reader, std::size_t sample);

// Allowed difference of a sample of this origin regenerated here, as a fraction of the map's peak and of a measured
// column: 0 for this program version on this kind of processor, else kOtherProcessor.
double reproduction_tolerance(const Provenance& origin);

// Differences between a stored and a regenerated sample, one entry each: map, complex map if both have one, hop code,
// columns of the row with SCR and features. Empty when all agree within the tolerance; tolerance 0 means bit for bit.
std::vector<std::string> differences(const Sample& stored, const Sample& again, double tolerance);

}  // namespace seaglint

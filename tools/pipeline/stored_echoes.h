// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The echoes that a data set stores (dataset.echoes: true) as responses of its targets, for maps with other clutter,
// other map settings and other features.

#include <cstddef>
#include <memory>
#include <string>

#include "classify/dataset/directory/dataset_reader.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/process/shared_results.h"
#include "sim/scattering/solver/solve.h"
#include "sim/scenario/scenario.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

// Reads a data set's echoes, shard by shard. Any thread may use it.
class StoredEchoes {
 public:
  // Throws InputError when the data set has no echoes.
  explicit StoredEchoes(const DatasetReader& reader);

  // The response of a sample's target at the pulses and frequencies of `train`, as it was computed, to the bit. Throws
  // InputError naming a damaged shard, or a sample whose echo has other pulses or frequencies.
  IntervalResult response(std::size_t sample, const PulseTrain& train) const;

 private:
  static constexpr std::size_t kKept = 4;  // shards
  const DatasetReader& reader_;
  mutable SharedResults<std::size_t, Shard> shards_{kKept};
};

// Throws InputError, naming the key, when a pipeline's scenario differs from `stored`, that of the data set, in what
// its echoes depend on: everything but `clutter`, `map` (with the same range window), `features`, `learning`, name,
// and of `dataset` the split, complex_maps, echoes and maps_per_shard.
void require_same_echoes(const Pipeline& pipeline, const Scenario& stored);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A data set as learning sees it: one row per map.

#include <functional>
#include <string>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/model/booster.h"
#include "classify/model/split.h"
#include "sim/core/process/parallel.h"

namespace seaglint {

// What a probe may say about the classes.
enum class ProbeKind {
  kBlind,    // random by construction: any accuracy away from 50 % is a leak
  kScale,    // absolute level: a ship is stronger, so it separates; features are normalised and see it by kRatio alone
  kRatio,    // target over clutter and noise: decides which centres are found, and so reaches every feature
  kFeature,  // a hand-made feature alone: which of them carries the result
  kShape,    // follows from the target's shape or motion: may separate honestly, shown to judge the features by
};
const char* name(ProbeKind kind);  // "blind", "scale", "ratio", "shape", "feature"

// Nuisance quantities of every map, to be classified by themselves.
struct Probe {
  std::string name;
  ProbeKind kind = ProbeKind::kBlind;
  std::string meaning;
  FeatureMatrix features;
};

struct LearningTable {
  std::vector<RowGroup> groups;
  std::vector<std::int64_t> samples;
  std::vector<int> labels;
  std::vector<double> wave_heights_m;
  std::vector<double> azimuths_deg;
  FeatureMatrix handmade;     // mwr, ccf, sigma_r, sigma_v
  std::vector<float> inputs;  // of the network, [map][kInputCells]
  std::vector<Probe> probes;
  std::size_t degenerate = 0;  // maps with fewer than 3 centres

  std::size_t rows() const { return labels.size(); }
};

// Reads every shard, once, and hands each on to `use` where there is one. Throws InputError when a shard is unsound, a
// feature is not finite, or there are not two classes.
LearningTable load_learning_table(const DatasetReader& data, const LearningSpec& spec, const StopFlag* stop = nullptr,
                                  const std::function<void(const Shard&)>& use = {});

}  // namespace seaglint

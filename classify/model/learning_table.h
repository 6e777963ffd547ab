// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A data set as input of the learning: one row per map.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "classify/cnn/network.h"
#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/sample.h"
#include "classify/model/classifiers.h"
#include "classify/model/data_rows.h"
#include "classify/model/division.h"
#include "sim/core/process/parallel.h"

namespace seaglint {

// How a probe's quantity is related to the class.
enum class ProbeKind {
  kBlind,  // random by construction: any accuracy away from 50 % is a leak
  kScale,  // absolute level: separates, as a ship is stronger; features are normalised and depend on it through kRatio
           // only
  kRatio,  // target over clutter and noise: determines which centres are found, and so affects every feature
  kFeature,  // a hand-made feature alone: shows which of them separates
  kShape,    // depends on the target's shape or motion: may separate without a leak; baseline for the features
};
const char* name(ProbeKind kind);  // "blind", "scale", "ratio", "shape", "feature"

// Quantities of every map that are classified in isolation, to detect leaks.
struct Probe {
  std::string name;
  ProbeKind kind = ProbeKind::kBlind;
  std::string meaning;
  FeatureMatrix features;
};

struct LearningTable {
  std::vector<std::string> classes = default_classes();  // names by label
  std::vector<RowGroup> groups;
  std::vector<std::int64_t> samples;
  std::vector<int> labels;
  std::vector<DataRow> maps;        // the columns of each
  FeatureMatrix handmade;           // mwr, ccf, sigma_r, sigma_v
  FeatureMatrix extended;           // the same and motion_features()
  std::vector<CentreList> centres;  // of every map, input of the network
  std::vector<Probe> probes;
  std::size_t degenerate = 0;              // maps with fewer than 3 centres
  std::optional<Division> other_division;  // of the group protocol, in place of that by sea

  std::size_t rows() const { return labels.size(); }
  Division division() const { return other_division ? *other_division : division_by_sea(groups); }
};

// The stored centres of a map, input of the network.
CentreList centres_of(const Sample& sample);

// motion_features() of every map.
FeatureMatrix motion_matrix(std::span<const CentreList> centres);

// Appends the rows of another data set, which get its number. Throws InputError when the carriers of both differ (in
// the probe of the hop code).
void append(LearningTable& table, LearningTable&& more);

// Throws InputError, naming `data`, when a class has no map, or every hand-made feature has one value in all maps.
void require_learnable(const LearningTable& table, const std::string& data);

// Reads every shard once and passes it to `use` if given; `classes`: those of the scenario. Throws InputError when a
// shard is invalid, a sample has a fault (classify/dataset/format/sample.h; with its number) or a label that is
// no class.
LearningTable load_learning_table(const DatasetReader& data, const StopFlag* stop = nullptr,
                                  const std::function<void(const Shard&)>& use = {},
                                  const std::vector<std::string>& classes = default_classes());

// What a map has outside of its target: clutter, noise, and what the processing leaks into them (range side lobes of
// the hop pedestal). Where it separates targets of equal geometry, the data set has a leak.
inline constexpr double kBlankedMarginM = 6;                  // beyond the outermost centres
inline constexpr int kBlankedDistances = 4;                   // bands of the distance from the blanked ranges
inline constexpr int kBlankedVelocities = 8;                  // bands of the velocity, equal numbers of cells
inline constexpr double kBlankedDistancesM[] = {10, 25, 50};  // their limits; the last band has the rest of the map

// Mean power of bands of the cells whose ranges are outside of [first centre - margin, last centre + margin], dB above
// the mean of all these cells: [distance][velocity], kBlankedDistances kBlankedVelocities values. 0 where a band has no
// cell, and everywhere when no range is left or the rest has no power. The level itself, which is the signal-to-clutter
// ratio, is left out (other probes have it).
std::vector<double> blanked_levels_db(const Sample& sample, const StoredAxes& axes);

}  // namespace seaglint

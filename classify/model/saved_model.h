// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A trained model as it is applied to other data: description, network and trees of a model directory.

#include <array>
#include <cstdint>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "classify/cnn/network.h"
#include "classify/model/classifiers.h"
#include "classify/model/data_rows.h"
#include "classify/model/model_card.h"
#include "classify/model/study.h"

namespace seaglint {

struct SavedModel {
  ModelCard card;
  LearningSpec spec;
  Network network;
  std::vector<Booster> trees;  // in the order of kModelNames

  // Throws InputError naming a file that is missing, damaged, of another training than model.json (checksum), or of
  // another version; WorkError when libtorch cannot be loaded.
  static SavedModel load(const std::filesystem::path& directory, const std::string& program_version);
};

// Description of a study's model: ranges over the training rows of the group protocol, first repeat.
// Checksums are left empty.
ModelCard describe_model(const Study& study, const LearningTable& table, const Scenario& scenario,
                         const StoredAxes& axes, const std::string& program_version);

// Writes model.json with the checksums of the model's other files, which must be written before.
void save_model_card(ModelCard card, const std::filesystem::path& directory);

// The maps that a model was fitted to, and the seas that they are in.
struct TrainedRows {
  std::set<std::pair<std::size_t, std::int64_t>> samples;  // number of the training data set, number of the sample
  std::set<std::pair<std::int64_t, std::int64_t>> seas;    // seed, sea_key
};
// Reads splits.csv of a model directory. Throws InputError naming file and line.
TrainedRows read_trained_rows(const std::filesystem::path& directory);

// Throws InputError naming the data set when its maps have another grid or other classes, or its features other
// settings than the model's.
void require_applicable(const ModelCard& card, const std::filesystem::path& data_set, const Scenario& scenario,
                        const StoredAxes& axes);

// Outputs of the classifiers for maps of one or more data sets.
struct AppliedRows {
  std::vector<DataRow> rows;
  FeatureMatrix features;                                  // hand-made, as stored in the data sets
  std::array<std::vector<double>, kModels> probabilities;  // [row][output] (outputs_of()), in the order of kModelNames

  // The outputs of one classifier for one row.
  std::span<const double> outputs(std::size_t model, std::size_t row) const {
    const std::size_t count = probabilities[model].size() / rows.size();
    return {&probabilities[model][row * count], count};
  }
};

// Appends the outputs for the samples of a shard that was read from `file`. Throws InputError naming file and sample
// for a fault (a value that is not finite) and for a label that the model has no class of.
void apply_model(const SavedModel& model, const Shard& shard, const std::filesystem::path& file, std::size_t data_set,
                 AppliedRows& result);

}  // namespace seaglint

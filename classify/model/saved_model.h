// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A trained model as it is applied to other data: description (model.json: all that is needed, with the checksum of
// every other file), network and trees of a model directory.

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "classify/cnn/network.h"
#include "classify/dataset/format/sample.h"
#include "classify/model/classifiers.h"
#include "classify/model/data_rows.h"
#include "classify/model/study.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// An axis of uniform cells.
struct AxisExtent {
  std::uint64_t cells = 0;
  double first = 0;
  double last = 0;
};
struct StoredGrid {
  AxisExtent range_m;
  AxisExtent velocity_mps;
};
StoredGrid grid_of(const StoredAxes& axes);

// "" when both are the same up to rounding, else "velocity_mps: 64 cells from ... to ... instead of ...".
std::string grid_difference(const StoredGrid& grid, const StoredGrid& of_model);

// A data set that the model was trained on.
struct TrainingData {
  std::string scenario;         // its name
  std::string scenario_sha256;  // of its scenario.yaml: sets of one scenario have the same maps
  std::uint64_t seed = 0;
  std::uint64_t samples = 0;
};

// Keys of a section of the effective scenario with their values as YAML.
using SectionSettings = std::vector<std::pair<std::string, std::string>>;

struct ModelCard {
  std::string program_version;
  std::uint64_t seed = 0;              // of training, validation and intervals
  std::vector<std::string> classes;    // names of label 0, 1, ...
  std::vector<std::string> features;   // hand-made: names of sample columns, in the order of the trees' columns
  std::vector<std::string> embedding;  // of the network
  StoredGrid grid;
  std::map<std::string, SectionSettings> settings;  // map, features, learning: of the first data set
  std::vector<TrainingData> data_sets;
  std::string division;                       // text of the division
  std::uint64_t train_rows = 0;               // maps that network or trees were fitted to
  std::vector<ValueRange> feature_ranges;     // over these maps, in the order of `features`
  std::vector<ValueRange> condition_ranges;   // over these maps
  std::map<std::string, std::string> sha256;  // of the other files of the model, by name
};

// "" when both have the same names in the same order, else "array, ship instead of decoys, ship".
std::string classes_difference(const std::vector<std::string>& classes, const std::vector<std::string>& of_model);

// Sections of the scenario on which features and the network's input depend, and the settings of the learning but
// for the number of threads, which changes no result.
std::map<std::string, SectionSettings> settings_of(const Scenario& scenario);

// "" when both have the same keys and values in the sections `map` and `features`, else the first difference:
// "features.max_centres: 32 instead of 64".
std::string settings_difference(const std::map<std::string, SectionSettings>& settings,
                                const std::map<std::string, SectionSettings>& of_model);

// The settings of the learning as a spec. Throws InputError naming the file when a key or value is not this version's.
LearningSpec learning_spec(const ModelCard& card, const std::filesystem::path& file);

std::string to_json(const ModelCard& card);
// Throws InputError naming the file and the entry: no such file, damaged, of another format or another version than
// `program_version`, this program's.
ModelCard read_model_card(const std::filesystem::path& file, const std::string& program_version);

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

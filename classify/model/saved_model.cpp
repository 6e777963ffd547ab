// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/saved_model.h"

#include <fmt/format.h>

#include <optional>

#include "classify/cnn/network_input.h"
#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/sample.h"
#include "classify/features/feature_vector.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

std::string tree_file(const char* name) { return fmt::format("{}.json", name); }

// The files that model.json has checksums of.
std::vector<std::string> checked_files() {
  std::vector<std::string> files{kNetworkFile, kSplitsFile};
  for (const char* name : kModelNames) files.push_back(tree_file(name));
  return files;
}

}  // namespace

SavedModel SavedModel::load(const fs::path& directory, const std::string& program_version) {
  const fs::path file = directory / kModelFile;
  if (fs::is_directory(directory) && !fs::exists(file)) {
    throw InputError(fmt::format("{}: no {}: not the model of `seaglint train`", directory.string(), kModelFile));
  }
  ModelCard card = read_model_card(file, program_version);
  for (const std::string& name : checked_files()) {
    const auto found = card.sha256.find(name);
    if (found == card.sha256.end() || found->second != sha256_file(directory / name))
      throw InputError(
          fmt::format("{}: damaged, or of another training than {}", (directory / name).string(), file.string()));
  }
  LearningSpec spec = learning_spec(card, file);
  std::vector<Booster> trees;
  for (const char* name : kModelNames) trees.push_back(Booster::load(directory / tree_file(name)));
  const std::size_t embedding = card.embedding.size(), features = card.features.size();
  const std::array<std::size_t, kModels> columns{features, embedding, features + embedding,
                                                 features + kMotionFeatureNames.size()};
  for (std::size_t i = 0; i < trees.size(); ++i) {
    if (trees[i].columns() != columns[i]) {
      throw InputError(fmt::format("{}: trees of {} columns, by {} {}",
                                   (directory / tree_file(kModelNames[i])).string(), trees[i].columns(), file.string(),
                                   columns[i]));
    }
  }
  Network network = Network::load(directory / kNetworkFile);
  const auto require_classes = [&](const fs::path& of, std::size_t classes) {
    if (classes == card.classes.size()) return;
    throw InputError(
        fmt::format("{}: of {} classes, by {} {}", of.string(), classes, file.string(), card.classes.size()));
  };
  for (std::size_t i = 0; i < trees.size(); ++i)
    require_classes(directory / tree_file(kModelNames[i]), trees[i].classes());
  require_classes(directory / kNetworkFile, network.classes());
  return {std::move(card), spec, std::move(network), std::move(trees)};
}

ModelCard describe_model(const Study& study, const LearningTable& table, const Scenario& scenario,
                         const StoredAxes& axes, const std::string& program_version) {
  ModelCard card;
  card.program_version = program_version;
  card.seed = scenario.seed;
  card.classes = table.classes;
  card.features = table.handmade.names;
  card.embedding = study.embeddings.names;
  card.grid = grid_of(axes);
  card.settings = settings_of(scenario);
  card.division = study.division;
  const std::vector<std::size_t>& train = study.splits.back().train;
  card.train_rows = train.size();
  const auto add_ranges = [&](const std::vector<std::string>& names, std::vector<ValueRange>& ranges) {
    for (const std::string& name : names)
      ranges.push_back(range_of(column_of(table.maps, name), train, table.labels, card.classes.size()));
  };
  add_ranges(card.features, card.feature_ranges);
  add_ranges(condition_names(card.features), card.condition_ranges);
  return card;
}

void save_model_card(ModelCard card, const fs::path& directory) {
  for (const std::string& name : checked_files()) card.sha256[name] = sha256_file(directory / name);
  write_file(directory / kModelFile, to_json(card));
}

TrainedRows read_trained_rows(const fs::path& directory) {
  const TextTable table(TextSource::read(directory / kSplitsFile),
                        {"data_set", "sample", "seed", "sea_key", "by_group"}, 1);
  TrainedRows trained;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, 4) != "train") continue;
    std::array<std::int64_t, 4> numbers{};
    for (std::size_t column = 0; column < 4; ++column) {
      const auto number = parse_integer(table.text(row, column));
      if (!number || (column == 0 && *number < 0)) table.fail(row, column, "must be a whole number");
      numbers[column] = *number;
    }
    trained.samples.insert({static_cast<std::size_t>(numbers[0]), numbers[1]});
    trained.seas.insert({numbers[2], numbers[3]});
  }
  return trained;
}

void require_applicable(const ModelCard& card, const fs::path& data_set, const Scenario& scenario,
                        const StoredAxes& axes) {
  const std::string grid = grid_difference(grid_of(axes), card.grid);
  if (!grid.empty()) throw InputError(fmt::format("{}: maps of another grid: {}", data_set.string(), grid));
  const std::string classes = classes_difference(scenario.dataset.classes, card.classes);
  if (!classes.empty()) throw InputError(fmt::format("{}: maps of other classes: {}", data_set.string(), classes));
  const std::string settings = settings_difference(settings_of(scenario), card.settings);
  if (!settings.empty())
    throw InputError(fmt::format("{}: features of other settings: {}", data_set.string(), settings));
}

void apply_model(const SavedModel& model, const Shard& shard, const fs::path& file, std::size_t data_set,
                 AppliedRows& result) {
  FeatureMatrix handmade{model.card.features, {}};
  std::vector<CentreList> maps;
  for (const Sample& sample : shard.samples) {
    std::vector<std::string> faults = sample_faults(sample);
    if (sample.record.label < 0 || sample.record.label >= static_cast<std::int64_t>(model.card.classes.size()))
      faults.push_back(
          fmt::format("label {}: the model has classes 0 to {}", sample.record.label, model.card.classes.size() - 1));
    if (!faults.empty())
      throw InputError(fmt::format("{}: sample {}: {}", file.string(), sample.record.sample, faults.front()));
    const std::vector<float> values = values_of(sample.record, model.card.features);
    handmade.values.insert(handmade.values.end(), values.begin(), values.end());
    maps.push_back(centres_of(sample));
  }
  const FeatureMatrix embeddings = embedding_matrix(model.network.embed(maps));
  const FeatureMatrix fused = join_columns(handmade, embeddings);
  const FeatureMatrix extended = join_columns(handmade, motion_matrix(maps));
  const std::array<const FeatureMatrix*, kModels> columns{&handmade, &embeddings, &fused, &extended};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::vector<double> probabilities = model.trees[i].predict(*columns[i]);
    result.probabilities[i].insert(result.probabilities[i].end(), probabilities.begin(), probabilities.end());
  }
  result.features.names = model.card.features;
  result.features.values.insert(result.features.values.end(), handmade.values.begin(), handmade.values.end());
  append_rows(result.rows, data_set, shard);
}

}  // namespace seaglint

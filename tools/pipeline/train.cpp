// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/train.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/model/saved_model.h"
#include "classify/model/study.h"
#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/scenario/scenario.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

std::string embeddings_csv(const LearningTable& table, const FeatureMatrix& embeddings) {
  std::string text = "sample,group,label,significant_wave_height_m,azimuth_deg";
  for (const FeatureMatrix* matrix : {&table.handmade, &embeddings}) {
    for (const std::string& column : matrix->names) text += "," + column;
  }
  text += "\n";
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const SampleRecord& record = table.maps[row].record;
    text += fmt::format("{},{},{},{:g},{:g}", table.samples[row], table.groups[row].group, table.labels[row],
                        record.significant_wave_height_m, record.azimuth_deg);
    for (const FeatureMatrix* matrix : {&table.handmade, &embeddings}) {
      for (const float value : matrix->row(row)) text += fmt::format(",{}", value);
    }
    text += "\n";
  }
  return text;
}

// The keys of a section of the effective scenario with their values, typed as in YAML: numbers, booleans, strings.
nlohmann::ordered_json section_of(const Scenario& scenario, const std::string& section) {
  nlohmann::ordered_json json;
  for (const auto& [key, text] : section_values(scenario, section)) {
    const auto value = nlohmann::ordered_json::parse(text, nullptr, false);
    json[key] = value.is_discarded() ? nlohmann::ordered_json(text) : value;
  }
  return json;
}

// Data sets as they are read for learning.
struct LearningData {
  LearningTable table;
  StoredAxes axes;
  std::vector<Manifest> manifests;
};

nlohmann::ordered_json metrics_json(const Study& study, const LearningData& data, const Scenario& scenario) {
  const LearningTable& table = data.table;
  const Manifest& manifest = data.manifests.front();
  nlohmann::ordered_json json = to_json(study, scenario.learning);
  json["scenario"] = scenario.name;
  json["version"] = kVersion;
  json["seed"] = scenario.seed;
  json["learning"] = section_of(scenario, "learning");
  json["dataset"]["split"] = section_of(scenario, "dataset").at("split");
  json["data"] = {{"maps", table.rows()},
                  {"maps_with_fewer_than_3_centres", table.degenerate},
                  {"processors", manifest.processors},
                  {"scenario_sha256", manifest.scenario_sha256}};
  if (data.manifests.size() > 1) {
    for (const Manifest& other : data.manifests)
      json["data"]["sets"].push_back(
          {{"scenario", other.scenario}, {"maps", other.samples}, {"scenario_sha256", other.scenario_sha256}});
  }
  if (table.other_division) json["division"] = study.division;
  return json;
}

// Throws InputError unless the directory is empty, absent, or contains a model, complete or incomplete.
void require_own_directory(const fs::path& directory) {
  if (!fs::exists(directory)) return;
  if (!fs::is_directory(directory)) throw InputError(fmt::format("{}: is a file, not a directory", directory.string()));
  if (fs::exists(directory / kNetworkFile)) return;
  const std::vector<std::string> model_names = model_files();
  for (const auto& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename();
    if (name.ends_with(".tmp") || std::find(model_names.begin(), model_names.end(), name) != model_names.end())
      continue;
    throw InputError(fmt::format("{}: the directory contains no model, but {}", directory.string(), name));
  }
}

std::string joined(const std::vector<fs::path>& paths) {
  std::string text;
  for (const fs::path& path : paths) text += (text.empty() ? "" : ", ") + path.string();
  return text;
}

// Reads a data set; each shard is passed to `use` if given.
void read_data(LearningData& data, const DatasetReader& reader, const Scenario& scenario, const StopFlag* stop,
               const std::function<void(const Shard&)>& use) {
  const std::size_t number = data.manifests.size();
  const auto keep = [&](const Shard& shard) {
    if (number == 0) {
      data.axes = shard.axes;
    } else if (const std::string other = grid_difference(grid_of(shard.axes), grid_of(data.axes)); !other.empty()) {
      throw InputError(
          fmt::format("{}: maps of another grid than the first data set's: {}", reader.directory().string(), other));
    }
    if (use) use(shard);
  };
  LearningTable table = load_learning_table(reader, stop, keep, scenario.dataset.classes);
  if (number == 0) {
    data.table = std::move(table);
  } else {
    append(data.table, std::move(table));
  }
  data.manifests.push_back(reader.manifest());
}

// Numbers of the seas of all data sets, in the sea state of the first map of each.
std::vector<RowGroup> common_seas(std::span<const DataRow> rows, std::span<const RowGroup> groups) {
  const std::vector<std::int64_t> seas = sea_numbers(rows);
  std::map<std::int64_t, std::int64_t> state_of_sea;
  std::map<std::pair<std::size_t, std::int64_t>, std::int64_t> states;  // of each data set
  std::vector<RowGroup> result;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::pair<std::size_t, std::int64_t> own{rows[row].data_set, groups[row].sea_state};
    const auto next = static_cast<std::int64_t>(states.size());
    const std::int64_t state = states.try_emplace(own, next).first->second;
    result.push_back({seas[row], state_of_sea.try_emplace(seas[row], state).first->second});
  }
  return result;
}

// Divides the rows as the scenario states; by sea alone needs no column.
void divide_rows(LearningData& data, const Scenario& scenario) {
  const DivisionRequest request = division_request(scenario.learning.split);
  LearningTable& table = data.table;
  if (!request.is_default()) table.other_division = make_division(table.maps, table.groups, table.labels, request);
  if (!request.is_default() || data.manifests.size() > 1) require_classes(table.division(), table.labels, scenario);
}

// Throws InputError when a data set has other classes, map or feature settings than the first.
void require_same_settings(const fs::path& data_set, const fs::path& first, const Scenario& of_first) {
  const Scenario own = read_scenario(data_set / kScenarioFile);
  const std::string classes = classes_difference(own.dataset.classes, of_first.dataset.classes);
  if (!classes.empty())
    throw InputError(fmt::format("{}: other classes than {}: {}", data_set.string(), first.string(), classes));
  const std::string other = settings_difference(settings_of(own), settings_of(of_first));
  if (!other.empty())
    throw InputError(fmt::format("{}: other settings than {}: {}", data_set.string(), first.string(), other));
}

TrainedModel train_on(const LearningData& data, const Scenario& scenario, const TrainRequest& request) {
  const fs::path& model_directory = request.model_directory;
  make_directory(model_directory);
  TrainedModel model;
  model.study = run_study(data.table, scenario.learning, scenario.dataset.train_fraction, scenario.seed,
                          thread_count(request.threads), request.stop, request.scope);
  model.metrics = metrics_json(model.study, data, scenario).dump(2) + "\n";
  ModelCard card = describe_model(model.study, data.table, scenario, data.axes, kVersion);
  for (const Manifest& manifest : data.manifests)
    card.data_sets.push_back({manifest.scenario, manifest.scenario_sha256, manifest.seed, manifest.samples});

  // metrics.json marks a complete model: the earlier one is removed before any other file is replaced.
  const fs::path mark = model_directory / kMetricsFile;
  std::error_code error;
  fs::remove(mark, error);
  if (error) throw WorkError(fmt::format("{}: cannot remove: {}", mark.string(), error.message()));
  save_models(model.study, data.table, model_directory);
  save_model_card(std::move(card), model_directory);
  write_file(model_directory / kEmbeddingsFile, embeddings_csv(data.table, model.study.embeddings));
  write_file(mark, model.metrics);
  remove_leftovers(model_directory);
  return model;
}

}  // namespace

void require_classes(const Division& division, std::span<const int> labels, const Scenario& scenario) {
  const std::vector<std::string>& classes = scenario.dataset.classes;
  for (int repeat = 0; repeat < scenario.learning.split_repeats; ++repeat) {
    const Split split = divide(division, Protocol::kGroup, scenario.dataset.train_fraction, scenario.seed,
                               static_cast<std::uint64_t>(repeat));
    for (const auto& [rows, use] : {std::pair(&split.train, "train"), std::pair(&split.test, "test")}) {
      if (rows->empty()) throw InputError(fmt::format("{}: leaves no map to {} on", division.text, use));
      const int label = labels[rows->front()];
      if (std::all_of(rows->begin(), rows->end(), [&](std::size_t row) { return labels[row] == label; })) {
        throw InputError(fmt::format("{}: leaves {} maps to {} on, all of class {} ({})", division.text, rows->size(),
                                     use, label, classes[static_cast<std::size_t>(label)]));
      }
    }
    std::set<int> trained;
    for (const std::size_t row : split.train) trained.insert(labels[row]);
    for (int label = 0; label < static_cast<int>(classes.size()); ++label) {
      if (!trained.contains(label)) {
        throw InputError(fmt::format("{}: leaves no map of class {} ({}) to train on", division.text, label,
                                     classes[static_cast<std::size_t>(label)]));
      }
    }
  }
}

TrainedModel train_model(const TrainRequest& request) {
  const std::vector<fs::path>& data_sets = request.data_sets;
  SEAGLINT_CHECK(!data_sets.empty(), "no data set");
  require_own_directory(request.model_directory);
  // A directory that is no data set is refused before its scenario is read.
  [[maybe_unused]] const DatasetReader is_data_set(data_sets.front());
  Scenario scenario = request.scenario != nullptr ? *request.scenario
                                                  : read_scenario(data_sets.front() / kScenarioFile, request.overrides);
  if (is_sea_alone(scenario)) {
    throw InputError(
        fmt::format("{}: maps of the sea alone: learning needs targets of two classes", joined(data_sets)));
  }
  SplitSpec& split = scenario.learning.split;
  if (request.division.by) split.by = *request.division.by;
  if (!request.division.hold_out.empty()) split.hold_out = request.division.hold_out;
  LearningData learning;
  std::vector<std::string> warnings;
  std::map<std::string, fs::path> scenarios;
  for (const fs::path& data_set : data_sets) {
    const DatasetReader reader(data_set);
    std::ranges::move(data_set_warnings(reader), std::back_inserter(warnings));
    const auto [first, is_new] = scenarios.try_emplace(reader.manifest().scenario_sha256, data_set);
    if (!is_new) {
      throw InputError(
          fmt::format("{}: the same maps as {}: of one scenario", data_set.string(), first->second.string()));
    }
    if (data_sets.size() > 1) require_same_settings(data_set, data_sets.front(), scenario);
    read_data(learning, reader, scenario, request.stop, request.use);
  }
  LearningTable& table = learning.table;
  require_learnable(table, joined(data_sets));
  if (data_sets.size() > 1) table.groups = common_seas(table.maps, table.groups);
  divide_rows(learning, scenario);
  TrainedModel model = train_on(learning, scenario, request);
  model.warnings = std::move(warnings);
  return model;
}

}  // namespace seaglint

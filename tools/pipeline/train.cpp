// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/train.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/model/study_text.h"
#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/temporary_file.h"
#include "sim/scenario/writer.h"
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
    text += fmt::format("{},{},{},{:g},{:g}", table.samples[row], table.groups[row].group, table.labels[row],
                        table.wave_heights_m[row], table.azimuths_deg[row]);
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

nlohmann::ordered_json metrics_json(const Study& study, const LearningTable& table, const Scenario& scenario,
                                    const Manifest& manifest) {
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

}  // namespace

TrainedModel train_model(const DatasetReader& data, const Scenario& scenario, const fs::path& model_directory,
                         int threads, const StopFlag* stop, const std::function<void(const Shard&)>& use) {
  require_own_directory(model_directory);
  const LearningTable table = load_learning_table(data, scenario.learning, stop, use);
  make_directory(model_directory);
  TrainedModel model;
  model.study =
      run_study(table, scenario.learning, scenario.dataset.train_fraction, scenario.seed, thread_count(threads), stop);
  model.metrics = metrics_json(model.study, table, scenario, data.manifest());

  // metrics.json marks a complete model: the earlier one is removed before any other file is replaced.
  const fs::path mark = model_directory / kMetricsFile;
  std::error_code error;
  fs::remove(mark, error);
  if (error) throw WorkError(fmt::format("{}: cannot remove: {}", mark.string(), error.message()));
  save_models(model.study, table, model_directory);
  write_file(model_directory / kEmbeddingsFile, embeddings_csv(table, model.study.embeddings));
  write_file(mark, model.metrics.dump(2) + "\n");
  remove_leftovers(model_directory);
  return model;
}

TrainedModel train_model(const fs::path& data_set, const fs::path& model_directory,
                         const std::vector<Override>& overrides, int threads, const StopFlag* stop) {
  const DatasetReader data(data_set);
  warn(data_set_warnings(data));
  return train_model(data, read_scenario(data_set / kScenarioFile, overrides), model_directory, threads, stop);
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/train.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/model/study_text.h"
#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/scenario/files/document.h"
#include "sim/scenario/writer.h"

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

// The keys of a section of the effective scenario with their values as YAML has them: numbers, flags, words.
nlohmann::ordered_json section_of(const Scenario& scenario, const std::string& section) {
  nlohmann::ordered_json json;
  const YamlNode effective = parse_yaml(effective_yaml(scenario), scenario.name);
  for (const YamlEntry& entry : effective.find(section)->entries) {
    const auto value = nlohmann::ordered_json::parse(entry.value.text, nullptr, false);
    json[entry.key] = value.is_discarded() ? nlohmann::ordered_json(entry.value.text) : value;
  }
  return json;
}

std::string metrics_json(const Study& study, const LearningTable& table, const Scenario& scenario,
                         const Manifest& manifest) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(to_json(study, scenario.learning));
  json["scenario"] = scenario.name;
  json["version"] = kVersion;
  json["seed"] = scenario.seed;
  json["learning"] = section_of(scenario, "learning");
  json["dataset"]["split"] = section_of(scenario, "dataset").at("split");
  json["data"] = {{"maps", table.rows()},
                  {"maps_with_fewer_than_3_centres", table.degenerate},
                  {"processors", manifest.processors},
                  {"scenario_sha256", manifest.scenario_sha256}};
  return json.dump(2) + "\n";
}

// Empty, absent, or with a model in it, be it one that a killed training left half-written.
void require_own_directory(const fs::path& directory) {
  if (!fs::exists(directory)) return;
  if (!fs::is_directory(directory)) throw InputError(fmt::format("{}: is a file, not a directory", directory.string()));
  if (fs::exists(directory / kNetworkFile)) return;
  const std::vector<std::string> ours = model_files();
  for (const auto& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename();
    if (name.ends_with(".tmp") || std::find(ours.begin(), ours.end(), name) != ours.end()) continue;
    throw InputError(fmt::format("{}: the directory holds no model, but {}", directory.string(), name));
  }
}

}  // namespace

Study train_model(const fs::path& data_set, const fs::path& model_directory, const std::vector<Override>& overrides,
                  int threads, const StopFlag* stop) {
  const DatasetReader data(data_set);
  const Scenario scenario = read_scenario(data_set / kScenarioFile, overrides);
  require_own_directory(model_directory);
  const LearningTable table = load_learning_table(data, scenario.learning, stop);
  make_directory(model_directory);
  Study study =
      run_study(table, scenario.learning, scenario.dataset.train_share, scenario.seed, thread_count(threads), stop);
  const std::string metrics = metrics_json(study, table, scenario, data.manifest());

  // metrics.json is the mark of a whole model: the earlier one goes before any other file is replaced.
  const fs::path mark = model_directory / kMetricsFile;
  std::error_code error;
  fs::remove(mark, error);
  if (error) throw WorkError(fmt::format("{}: cannot remove: {}", mark.string(), error.message()));
  save_models(study, table, model_directory);
  write_file(model_directory / kEmbeddingsFile, embeddings_csv(table, study.embeddings));
  write_file(mark, metrics);
  return study;
}

}  // namespace seaglint

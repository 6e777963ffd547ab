// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/evaluate.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/directory/file_names.h"
#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/progress.h"
#include "tools/evaluate/evaluation_text.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

// Throws InputError for a directory of a data set or model, WorkError where nothing can be written.
void require_output(const fs::path& directory) {
  if (directory.empty()) return;
  if (fs::exists(directory) && !fs::is_directory(directory))
    throw InputError(fmt::format("{}: is a file, not a directory", directory.string()));
  for (const char* file : {kScenarioFile, kManifestFile, kModelFile}) {
    if (fs::exists(directory / file))
      throw InputError(fmt::format("{}: is the directory of a data set, run or model", directory.string()));
  }
  fs::path there = directory;
  while (!fs::exists(there) && there.has_relative_path()) there = there.parent_path();
  require_writable((there.empty() ? fs::path(".") : there) / kEvaluationFile);
}

}  // namespace

EvaluatedModel evaluate_model(const EvaluateRequest& request, const StopFlag* stop) {
  require_output(request.output);
  // Refuses an unknown column before any work; keys that are drawn are known when the rows are.
  for (const std::string& name : request.by)
    if (name.find('.') == std::string::npos) column_of({}, name);
  EvaluatedModel result;
  std::vector<DatasetReader> readers;
  std::map<std::string, std::string> scenarios;
  for (const fs::path& data_set : request.data_sets) {
    readers.emplace_back(data_set);
    const std::vector<std::string> warnings = data_set_warnings(readers.back());
    result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
    const auto [first, is_new] = scenarios.try_emplace(readers.back().manifest().scenario_sha256, data_set.string());
    if (!is_new)
      throw InputError(fmt::format("{}: the same maps as {}: of one scenario", data_set.string(), first->second));
  }
  const SavedModel model = SavedModel::load(request.model, kVersion);
  const TrainedRows trained = read_trained_rows(request.model);

  std::size_t shards = 0;
  for (const DatasetReader& reader : readers) shards += reader.shards();
  AppliedRows applied;
  {
    Progress progress("evaluating shards", shards);
    for (std::size_t i = 0; i < readers.size(); ++i) {
      const Scenario scenario = read_scenario(readers[i].directory() / kScenarioFile);
      for (std::size_t k = 0; k < readers[i].shards(); ++k) {
        if (stop && *stop) throw Interrupted();
        const Shard shard = readers[i].shard(k);
        require_applicable(model.card, readers[i].directory(), scenario, shard.axes);
        apply_model(model, shard, readers[i].directory() / readers[i].manifest().shards[k].file, i, applied);
        progress.advance();
      }
    }
  }

  // Number of each data set among those of the training.
  std::vector<std::optional<std::size_t>> training_set(readers.size());
  for (std::size_t i = 0; i < readers.size(); ++i)
    for (std::size_t k = 0; k < model.card.data_sets.size(); ++k)
      if (readers[i].manifest().scenario_sha256 == model.card.data_sets[k].scenario_sha256) training_set[i] = k;
  std::vector<TrainingUse> uses;
  for (const DataRow& row : applied.rows) {
    const auto& set = training_set[row.data_set];
    const bool is_trained = set && trained.samples.contains({*set, row.record.sample});
    const bool is_seen = trained.seas.contains({row.record.seed, row.record.sea_key});
    uses.push_back(is_trained ? TrainingUse::kTrained : is_seen ? TrainingUse::kSeaSeen : TrainingUse::kNone);
  }

  const ModelEvaluation evaluation = evaluate_rows(model, std::move(applied), std::move(uses), request);
  std::vector<Manifest> manifests;
  for (const DatasetReader& reader : readers) manifests.push_back(reader.manifest());
  result.text = evaluation_table(evaluation, model, request);
  result.json = evaluation_json(evaluation, model, request, manifests);
  if (!request.output.empty()) {
    make_directory(request.output);
    write_file(request.output / kProbabilitiesFile, probabilities_csv(evaluation, model.card.classes));
    write_file(request.output / kEvaluationFile, result.json);
    result.text += fmt::format("\n{}: {}, {}\n", request.output.string(), kEvaluationFile, kProbabilitiesFile);
  }
  return result;
}

}  // namespace seaglint

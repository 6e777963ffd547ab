// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/classify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/directory/file_names.h"
#include "classify/model/saved_model.h"
#include "classify/model/scores.h"
#include "classify/model/study_text.h"
#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/progress.h"
#include "sim/core/text/shown.h"
#include "tools/evaluate/echo_file.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/regenerate.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

// The maps that are classified.
struct Classified {
  AppliedRows applied;
  std::optional<std::set<std::string>> known;  // columns of the rows that have values; all unless given

  bool has(const std::string& column) const { return !known || known->contains(column); }
};

// Names of the features and conditions of a row outside the training range.
std::vector<std::string> outside(const ModelCard& card, const Classified& maps, std::size_t index) {
  const DataRow& row = maps.applied.rows[index];
  std::vector<std::string> names;
  for (const auto* ranges : {&card.feature_ranges, &card.condition_ranges})
    for (const ValueRange& range : *ranges)
      if (maps.has(range.name) && range.excludes(column_of({&row, 1}, range.name).numbers.front()))
        names.push_back(range.name);
  return names;
}

const std::string& decided(const ModelCard& card, std::span<const double> outputs) {
  return card.classes[static_cast<std::size_t>(decision_of(outputs))];
}

// The classes whose probabilities are shown: the second of two, or all.
std::vector<std::string> shown_classes(const ModelCard& card) {
  return card.classes.size() == 2 ? std::vector{card.classes[1]} : card.classes;
}

// Four digits, a dash for an undefined value.
std::string digits(double value) { return std::isnan(value) ? "-" : fmt::format("{:.4g}", value); }

// "sample 3: ship (truth: ship), Hs 1 m, azimuth 30 deg", without what is not known of the map.
std::string title(const SavedModel& model, const Classified& maps) {
  const SampleRecord& record = maps.applied.rows.front().record;
  std::string text = maps.has("sample") ? fmt::format("sample {}", record.sample) : "interval";
  if (maps.has("target_name")) text += fmt::format(": {}", shown(record.target_name));
  text += maps.has("label") ? fmt::format(" (truth: {})", model.card.classes[static_cast<std::size_t>(record.label)])
                            : " (truth not given)";
  if (maps.has("significant_wave_height_m")) text += fmt::format(", Hs {:g} m", record.significant_wave_height_m);
  if (maps.has("azimuth_deg")) text += fmt::format(", azimuth {:g} deg", record.azimuth_deg);
  return text + "\n";
}

std::string sample_text(const SavedModel& model, const Classified& maps) {
  const AppliedRows& applied = maps.applied;
  const DataRow& row = applied.rows.front();
  std::string text = title(model, maps);
  text += fmt::format("  {:<12}", "classifier");
  for (const std::string& name : shown_classes(model.card)) text += fmt::format("{:>24}", "P(" + name + ")");
  text += "  decision\n";
  for (std::size_t i = 0; i < kModelNames.size(); ++i) {
    text += fmt::format("  {:<12}", kModelNames[i]);
    for (const double probability : applied.outputs(i, 0)) text += fmt::format("{:>24.4f}", probability);
    text += fmt::format("  {}\n", decided(model.card, applied.outputs(i, 0)));
  }
  text += fmt::format("\n  {:<28}{:>12}{:>24}", "quantity", "value", "training range");
  for (const std::string& name : model.card.classes) text += fmt::format("{:>32}", name + ", 5 / 50 / 95 %");
  text += "\n";
  const auto add = [&](const ValueRange& range) {
    const bool known = maps.has(range.name);
    const double value = known ? column_of({&row, 1}, range.name).numbers.front() : std::nan("");
    text += fmt::format("  {:<28}{:>12}{:>24}", range.name, known ? digits(value) : "not given",
                        fmt::format("{} to {}", digits(range.lowest), digits(range.highest)));
    for (const ClassQuantiles& q : range.by_label)
      text += fmt::format("{:>32}", fmt::format("{} / {} / {}", digits(q[0]), digits(q[1]), digits(q[2])));
    text += known && range.excludes(value) ? "  outside\n" : "\n";
  };
  for (const ValueRange& range : model.card.feature_ranges) add(range);
  for (const ValueRange& range : model.card.condition_ranges) add(range);
  return text;
}

// Of two classes the probability of label 1; of more the decision with its probability.
std::string all_text(const SavedModel& model, const Classified& maps) {
  const AppliedRows& applied = maps.applied;
  const bool two = model.card.classes.size() == 2;
  const int width = two ? 12 : 24;
  std::string text = fmt::format("{:>8} {:<16}", "sample", "truth");
  for (const char* name : kModelNames) text += fmt::format("{:>{}}", name, width);
  text += two ? fmt::format("  P({}); outside the training range\n", model.card.classes[1])
              : "  decision, P(decision); outside the training range\n";
  for (std::size_t row = 0; row < applied.rows.size(); ++row) {
    const SampleRecord& record = applied.rows[row].record;
    text += fmt::format("{:>8} {:<16}", record.sample, model.card.classes[static_cast<std::size_t>(record.label)]);
    for (std::size_t i = 0; i < kModelNames.size(); ++i) {
      const std::span<const double> outputs = applied.outputs(i, row);
      text += two ? fmt::format("{:>12.4f}", outputs[0])
                  : fmt::format("{:>24}", fmt::format("{}, {:.4f}", decided(model.card, outputs),
                                                      outputs[static_cast<std::size_t>(decision_of(outputs))]));
    }
    text += fmt::format("  {}\n", fmt::join(outside(model.card, maps, row), " "));
  }
  return text;
}

// Sample and label are empty where they are not known.
std::string csv(const SavedModel& model, const Classified& maps) {
  const AppliedRows& applied = maps.applied;
  std::string text = "sample,label";
  for (const char* name : kModelNames)
    text += fmt::format(",{}", fmt::join(probability_columns(name, model.card.classes), ","));
  for (const std::string& feature : model.card.features) text += "," + feature;
  text += ",outside\n";
  for (std::size_t row = 0; row < applied.rows.size(); ++row) {
    const SampleRecord& record = applied.rows[row].record;
    text += fmt::format("{},{}", maps.has("sample") ? std::to_string(record.sample) : "",
                        maps.has("label") ? std::to_string(record.label) : "");
    for (std::size_t i = 0; i < kModelNames.size(); ++i)
      text += fmt::format(",{}", fmt::join(applied.outputs(i, row), ","));
    for (const float value : applied.features.row(row)) text += fmt::format(",{}", value);
    text += fmt::format(",{}\n", fmt::join(outside(model.card, maps, row), " "));
  }
  return text;
}

// Throws InputError for an output among the files of the data set or the model, WorkError where it cannot be written.
void require_table(const ClassifyRequest& request) {
  if (request.output.empty()) return;
  if (request.output.extension() != ".csv")
    throw InputError(fmt::format("{}: must end in .csv", request.output.string()));
  const fs::path folder = request.output.has_parent_path() ? request.output.parent_path() : fs::path(".");
  for (const fs::path& other : {request.model, request.data}) {
    if (fs::exists(folder) && fs::exists(other) && fs::equivalent(folder, other))
      throw InputError(fmt::format("{}: in the directory of the model or the data set", request.output.string()));
  }
  require_writable(request.output);
}

bool is_echo_file(const fs::path& data) { return data.extension() == ".npz" && !fs::is_directory(data); }

// Maps of a data set, one or all.
Classified classified_samples(const ClassifyRequest& request, const StopFlag* stop, const SavedModel& model,
                              const DatasetReader& reader) {
  const Scenario scenario = read_scenario(request.data / kScenarioFile);
  Classified maps;
  const auto apply = [&](const Shard& shard, const fs::path& file) {
    require_applicable(model.card, request.data, scenario, shard.axes);
    apply_model(model, shard, file, 0, maps.applied);
  };
  if (request.sample) {
    StoredSample stored = stored_sample(reader, *request.sample);
    apply({stored.origin, stored.axes, {std::move(stored.sample)}}, request.data);
  } else {
    Progress progress("classifying shards", reader.shards());
    for (std::size_t i = 0; i < reader.shards(); ++i) {
      if (stop && *stop) throw Interrupted();
      apply(reader.shard(i), reader.directory() / reader.manifest().shards[i].file);
      progress.advance();
    }
  }
  return maps;
}

// The map of an echo file. Its parts are at the levels that they were received with.
Classified classified_echo(const SavedModel& model, EchoFile file, const fs::path& path) {
  ClutterSpec as_received;
  as_received.level = ClutterLevel::kNrl;
  as_received.noise_level = NoiseLevel::kThermal;
  GeneratedSample made = sample_of_echo(file.echo, file.train, file.scenario, as_received, std::move(file.record));
  Classified maps;
  maps.known = std::move(file.given);
  maps.known->insert({"centres", "mwr", "ccf", "sigma_r_m", "sigma_v_mps"});
  const bool has_truth = maps.known->contains("label");
  for (const char* ratio : {"scr_per_pulse_db", "scr_peak_cell_db", "scr_extent_db", "snr_per_pulse_db"}) {
    if (file.is_measured) {
      maps.known->erase(ratio);
    } else {
      maps.known->insert(ratio);
    }
  }
  if (!has_truth) file.scenario.dataset.classes = model.card.classes;
  Shard shard;
  shard.axes = stored_axes(made.received.map);
  shard.samples.push_back(std::move(made.stored));
  require_applicable(model.card, path, file.scenario, shard.axes);
  apply_model(model, shard, path, 0, maps.applied);
  return maps;
}

}  // namespace

std::string classify_samples(const ClassifyRequest& request, const StopFlag* stop) {
  require_table(request);
  std::optional<SavedModel> model;
  Classified maps;
  const bool is_echo = is_echo_file(request.data);
  if (is_echo) {
    if (request.sample)
      throw InputError(
          fmt::format("--sample {}: {} is the echo of one interval", *request.sample, request.data.string()));
    EchoFile file = read_echo_file(request.data);
    model = SavedModel::load(request.model, kVersion);
    maps = classified_echo(*model, std::move(file), request.data);
  } else {
    const DatasetReader reader(request.data);
    warn(data_set_warnings(reader));
    if (request.sample && *request.sample >= reader.size())
      throw InputError(
          fmt::format("--sample {}: the data set has samples 0 to {}", *request.sample, reader.size() - 1));
    model = SavedModel::load(request.model, kVersion);
    maps = classified_samples(request, stop, *model, reader);
  }
  if (!request.output.empty()) write_file(request.output, csv(*model, maps));
  return is_echo || request.sample ? sample_text(*model, maps) : all_text(*model, maps);
}

}  // namespace seaglint

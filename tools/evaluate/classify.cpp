// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/classify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
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
#include "tools/pipeline/regenerate.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

// Names of the features and conditions of a row outside the training range.
std::vector<std::string> outside(const ModelCard& card, const DataRow& row) {
  std::vector<std::string> names;
  for (const auto* ranges : {&card.feature_ranges, &card.condition_ranges})
    for (const ValueRange& range : *ranges)
      if (range.excludes(column_of({&row, 1}, range.name).numbers.front())) names.push_back(range.name);
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

std::string sample_text(const SavedModel& model, const AppliedRows& applied) {
  const DataRow& row = applied.rows.front();
  const SampleRecord& record = row.record;
  std::string text = fmt::format("sample {}: {} (truth: {}), Hs {:g} m, azimuth {:g} deg\n", record.sample,
                                 record.target_name, model.card.classes[static_cast<std::size_t>(record.label)],
                                 record.significant_wave_height_m, record.azimuth_deg);
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
    const double value = column_of({&row, 1}, range.name).numbers.front();
    text += fmt::format("  {:<28}{:>12}{:>24}", range.name, digits(value),
                        fmt::format("{} to {}", digits(range.lowest), digits(range.highest)));
    for (const ClassQuantiles& q : range.by_label)
      text += fmt::format("{:>32}", fmt::format("{} / {} / {}", digits(q[0]), digits(q[1]), digits(q[2])));
    text += range.excludes(value) ? "  outside\n" : "\n";
  };
  for (const ValueRange& range : model.card.feature_ranges) add(range);
  for (const ValueRange& range : model.card.condition_ranges) add(range);
  return text;
}

// Of two classes the probability of label 1; of more the decision with its probability.
std::string all_text(const SavedModel& model, const AppliedRows& applied) {
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
    text += fmt::format("  {}\n", fmt::join(outside(model.card, applied.rows[row]), " "));
  }
  return text;
}

std::string csv(const SavedModel& model, const AppliedRows& applied) {
  std::string text = "sample,label";
  for (const char* name : kModelNames)
    text += fmt::format(",{}", fmt::join(probability_columns(name, model.card.classes), ","));
  for (const std::string& feature : model.card.features) text += "," + feature;
  text += ",outside\n";
  for (std::size_t row = 0; row < applied.rows.size(); ++row) {
    const SampleRecord& record = applied.rows[row].record;
    text += fmt::format("{},{}", record.sample, record.label);
    for (std::size_t i = 0; i < kModelNames.size(); ++i)
      text += fmt::format(",{}", fmt::join(applied.outputs(i, row), ","));
    for (const float value : applied.features.row(row)) text += fmt::format(",{}", value);
    text += fmt::format(",{}\n", fmt::join(outside(model.card, applied.rows[row]), " "));
  }
  return text;
}

// Throws InputError for an output among the files of the data set or the model, WorkError where it cannot be written.
void require_table(const ClassifyRequest& request) {
  if (request.output.empty()) return;
  if (request.output.extension() != ".csv")
    throw InputError(fmt::format("{}: must end in .csv", request.output.string()));
  const fs::path folder = request.output.has_parent_path() ? request.output.parent_path() : fs::path(".");
  for (const fs::path& other : {request.model, request.data_set}) {
    if (fs::exists(folder) && fs::exists(other) && fs::equivalent(folder, other))
      throw InputError(fmt::format("{}: in the directory of the model or the data set", request.output.string()));
  }
  require_writable(request.output);
}

}  // namespace

std::string classify_samples(const ClassifyRequest& request, const StopFlag* stop) {
  require_table(request);
  const DatasetReader reader(request.data_set);
  warn(data_set_warnings(reader));
  if (request.sample && *request.sample >= reader.size())
    throw InputError(fmt::format("--sample {}: the data set has samples 0 to {}", *request.sample, reader.size() - 1));
  const SavedModel model = SavedModel::load(request.model, kVersion);
  const Scenario scenario = read_scenario(request.data_set / kScenarioFile);

  AppliedRows applied;
  const auto apply = [&](const Shard& shard, const fs::path& file) {
    require_applicable(model.card, request.data_set, scenario, shard.axes);
    apply_model(model, shard, file, 0, applied);
  };
  if (request.sample) {
    StoredSample stored = stored_sample(reader, *request.sample);
    apply({stored.origin, stored.axes, {std::move(stored.sample)}}, request.data_set);
  } else {
    Progress progress("classifying shards", reader.shards());
    for (std::size_t i = 0; i < reader.shards(); ++i) {
      if (stop && *stop) throw Interrupted();
      apply(reader.shard(i), reader.directory() / reader.manifest().shards[i].file);
      progress.advance();
    }
  }
  if (!request.output.empty()) write_file(request.output, csv(model, applied));
  return request.sample ? sample_text(model, applied) : all_text(model, applied);
}

}  // namespace seaglint
